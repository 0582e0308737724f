import { createGlue } from 'glue:snapshot';
import { Module } from '../../runtime/module.js';
import { options } from './options.js';

/** The WebAssembly module of `morse-smooth/snapshot`. */
export const pictures = new Module(createGlue, 'morse-smooth/snapshot', 'rawscene_new', options);
export default pictures;
