// @ts-check
// The lessons in their order.

import { again } from './again.js';
import { discounts } from './discounts.js';
import { frontier } from './frontier.js';
import { jumps } from './jumps.js';
import { memory } from './memory.js';
import { reading } from './reading.js';
import { safety } from './safety.js';
import { sets } from './sets.js';
import { shaping } from './shaping.js';
import { until } from './until.js';

/** @type {readonly import('../model.js').Lesson[]} */
export const LESSONS = Object.freeze([reading, again, until, memory, frontier, sets, shaping, discounts, safety, jumps]);

/** The lesson of that name. @param {string} name */
export const lesson = (name) => LESSONS.find((l) => l.name === name);
