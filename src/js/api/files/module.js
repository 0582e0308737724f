import { createGlue } from 'glue:files';
import { Module } from '../../runtime/module.js';

/** The WebAssembly module of `morse-smooth/files`. */
export const files = new Module(createGlue, 'morse-smooth/files', 'readMesh');
export default files;
