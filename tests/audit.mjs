/**
 * `npm run test:audit`: known weaknesses of the packages that the page and the command are built from. Asks the registry,
 * so it is no part of `npm test`; where none answers, a line says so, and that is no failure.
 */
import { spawnSync } from 'node:child_process';
import { builtPackages } from './helpers/built-packages.mjs';

const arguments_ = ['audit', '--json', '--fetch-retries=0', '--fetch-timeout=20000'];
const { stdout } = spawnSync('npm', arguments_, {
  encoding: 'utf8',
  timeout: 60_000,
  shell: process.platform === 'win32',
});

const built = new Set(builtPackages());

/** How severe each weakness in a package that is built in is; undefined if there is no report. */
function read() {
  try {
    const { vulnerabilities } = JSON.parse(stdout);
    const found = vulnerabilities && Object.values(vulnerabilities);
    return found?.filter(({ nodes }) => nodes.some((path) => built.has(path))).map(({ severity }) => severity);
  } catch {
    return undefined;
  }
}

const found = read();
if (!found) console.log('Audit: the registry did not answer; nothing was checked.');
else {
  const count = (severity) => found.filter((one) => one === severity).length;
  const counts = ['critical', 'high', 'moderate', 'low'].map((severity) => `${count(severity)} ${severity}`);
  console.log(`Audit: ${counts.join(', ')}.`);
  if (count('critical') + count('high') > 0) process.exitCode = 1;
}
