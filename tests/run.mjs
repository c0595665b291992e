/**
 * `npm test`. What fails most often is told first: types, lint and the quick tests. Then the page is built beside the
 * deep tests, and last come the browsers, which have the machine to themselves. Everything runs whatever failed before
 * it, but for the browsers where there is no page. The last line counts the tests of all runs; a step that is no test
 * counts as a failed one where it fails.
 */
import { spawn } from 'node:child_process';
import { createInterface } from 'node:readline';

const COUNTS = /^(\d+) passed, (\d+) failed(?:, (\d+) skipped)?$/;
const env = { ...process.env, ...(process.stdout.isTTY && !process.env.NO_COLOR && { FORCE_COLOR: '1' }) };
const total = { passed: 0, failed: 0, skipped: 0 };
const started = performance.now();
const elapsed = () => `${Math.round((performance.now() - started) / 1000)} s`;

/** Runs a command of npm's, and gives each line that it prints. Resolves to whether it went well. */
function run(command, onLine) {
  const child = spawn(command, { shell: true, env, stdio: ['ignore', 'pipe', 'pipe'] });
  for (const stream of [child.stdout, child.stderr]) createInterface({ input: stream }).on('line', onLine);
  return new Promise((resolve) => child.once('close', (code) => resolve(code === 0)));
}

/** A script of package.json whose output only matters where it fails. */
async function step(script) {
  const lines = [];
  const passed = await run(`npm run --silent ${script}`, (line) => lines.push(line));
  if (!passed) {
    total.failed++;
    console.log(lines.join('\n'));
  }
  return passed;
}

/** The tests of projects of vite.config.ts. */
async function tests(...projects) {
  let counted = false;
  const passed = await run(`vitest run ${projects.map((name) => `--project ${name}`).join(' ')}`, (line) => {
    const found = COUNTS.exec(line);
    if (!found) return console.log(line);
    counted = true;
    total.passed += Number(found[1]);
    total.failed += Number(found[2]);
    total.skipped += Number(found[3] ?? 0);
  });
  if (!passed && !counted) total.failed++;
  return passed;
}

function verdict(what, results) {
  const passed = results.every(Boolean);
  console.log(`${what}: ${passed ? 'passed' : 'FAILED'} (${elapsed()} since the start)\n`);
  return passed;
}

const first = verdict(
  'Types, lint and unit tests',
  await Promise.all(['test:types', 'test:lint'].map(step).concat(tests('unit'))),
);
const [built, deep] = await Promise.all([step('build'), tests('deep', 'mocked')]);
const second = verdict('Build and deep tests', [built, deep]);
const third = verdict('Browser tests', [built && (await tests('browser'))]);

console.log(`${total.passed} passed, ${total.failed} failed${total.skipped ? `, ${total.skipped} skipped` : ''}`);
process.exitCode = first && second && third ? 0 : 1;
