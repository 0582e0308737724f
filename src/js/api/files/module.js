import { createGlue } from 'glue:files';
import { Module } from '../../runtime/module.js';
import { options } from './options.js';

/** The WebAssembly module of `morse-smooth/files`. */
export const files = new Module(createGlue, 'morse-smooth/files', 'readMesh', options);
export default files;
