import { createGlue } from 'glue:core';
import { Module } from '../../runtime/module.js';

/** The WebAssembly module of `morse-smooth`. */
export const core = new Module(createGlue, 'morse-smooth', 'rawtrimesh_new');
export default core;
