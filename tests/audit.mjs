/**
 * `npm run test:audit`: known weaknesses of the packages that the page and the command are built from. Asks the registry,
 * so it is no part of `npm test`; where none answers, a line says so, and that is no failure.
 */
import { spawnSync } from 'node:child_process';

const arguments_ = ['audit', '--omit=dev', '--json', '--fetch-retries=0', '--fetch-timeout=20000'];
const { stdout } = spawnSync('npm', arguments_, {
  encoding: 'utf8',
  timeout: 60_000,
  shell: process.platform === 'win32',
});

/** The report; undefined if there is none. */
function read() {
  try {
    return JSON.parse(stdout).metadata?.vulnerabilities;
  } catch {
    return undefined;
  }
}

const found = read();
if (!found) console.log('Audit: the registry did not answer; nothing was checked.');
else {
  const { critical, high, moderate, low } = found;
  console.log(`Audit: ${critical} critical, ${high} high, ${moderate} moderate, ${low} low.`);
  if (critical + high > 0) process.exitCode = 1;
}
