import { createGlue } from 'glue:snapshot';
import { Module } from '../../runtime/module.js';

/** The WebAssembly module of `morse-smooth/snapshot`. */
export const pictures = new Module(createGlue, 'morse-smooth/snapshot', 'rawscene_new');
export default pictures;
