// @ts-check
// The trained policies that come with the page: which tasks have one, and its file, fetched ahead for the task that the page opens with.

/** @param {string} task @returns {Promise<Uint8Array | null>} */
const fetched = (task) => fetch(`assets/policies/${encodeURIComponent(task)}.safetensors`)
  .then(async (answer) => (answer.ok ? new Uint8Array(await answer.arrayBuffer()) : null)).catch(() => null);

export class Policies {
  constructor() {
    /** The tasks that have one. @type {Promise<string[]>} */
    this.listed = fetch('policies.json').then((answer) => answer.json()).catch(() => []);
    /** One that is on its way. @type {{ task: string, bytes: Promise<Uint8Array | null> } | null} */
    this.ahead = null;
  }

  /** Fetches the policy of a task while its session is being opened. @param {string} task */
  async hasten(task) {
    if ((await this.listed).includes(task)) this.ahead = { task, bytes: fetched(task) };
  }

  /** The policy of a task, if it has one. @param {string} task */
  async of(task) {
    if (!(await this.listed).includes(task)) return null;
    return this.ahead?.task === task ? this.ahead.bytes : fetched(task);
  }
}
