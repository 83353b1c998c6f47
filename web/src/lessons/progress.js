// @ts-check
// What this reader has answered, kept in this browser only.

const KEY = 'ltl-rover lessons';

/**
 * Per lesson, per step: the choice that was committed to, and the one that the run bore out (−1 while it has not been run).
 * @typedef {Record<string, Record<number, { said: number, bore: number }>>} Progress
 */

/** @returns {Progress} */
export function readProgress() {
  try {
    const kept = JSON.parse(localStorage.getItem(KEY) ?? '{}');
    return kept && typeof kept === 'object' && !Array.isArray(kept) ? kept : {};
  } catch {
    return {};
  }
}

/** @param {Progress} progress */
function write(progress) {
  try {
    localStorage.setItem(KEY, JSON.stringify(progress));
  } catch {
    // Without storage the lessons work all the same; nothing is remembered.
  }
}

/** @param {string} lesson @param {number} step @param {{ said: number, bore: number }} answer */
export function keepAnswer(lesson, step, answer) {
  const progress = readProgress();
  write({ ...progress, [lesson]: { ...progress[lesson], [step]: answer } });
}

/** Forgets the answers of a lesson. @param {string} lesson */
export function forgetAnswers(lesson) {
  const { [lesson]: _, ...others } = readProgress();
  write(others);
}

/** How many questions of a lesson were answered and run. @param {Progress} progress @param {import('./model.js').Lesson} lesson */
export function answered(progress, lesson) {
  const kept = progress[lesson.name] ?? {};
  return lesson.steps.filter((step, k) => 'ask' in step && (kept[k]?.bore ?? -1) >= 0).length;
}
