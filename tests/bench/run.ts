/**
 * `npm run bench`: builds the page, then runs the benchmarks that the arguments name, as vitest takes them, or all.
 * `npm run bench -- gpu` compares frames on a GPU instead (`gpu/run.ts`).
 */
import { spawnSync } from 'node:child_process';
import { execPath } from 'node:process';
import { fileURLToPath } from 'node:url';

const ROOT = fileURLToPath(new URL('../../', import.meta.url));

/** Runs a program of a package, and returns its exit code. */
function node(path: string, ...args: readonly string[]): number {
  return spawnSync(execPath, [`${ROOT}node_modules/${path}`, ...args], { cwd: ROOT, stdio: 'inherit' }).status ?? 1;
}

const build = () => node('vite/bin/vite.js', 'build') === 0;

/** Returns the exit code. */
export async function run(args: readonly string[]): Promise<number> {
  const [first, ...others] = args;
  if (first === 'gpu') return (await import('./gpu/run.ts')).run(others, build);
  return build() ? node('vitest/vitest.mjs', 'bench', '--run', '--project', 'bench', ...args) : 1;
}
