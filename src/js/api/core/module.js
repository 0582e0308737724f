import { createGlue } from 'glue:core';
import { Module } from '../../runtime/module.js';
import { options } from './options.js';

/** The WebAssembly module of `morse-smooth`. */
export const core = new Module(createGlue, 'morse-smooth', 'rawtrimesh_new', options);
export default core;
