/**
 * Three things are built from here: the page (`vite build`, into dist/), the command (`vite build --mode cli`, into
 * build/, which is not published with the page), and the tests' projects.
 */
import { chmodSync } from 'node:fs';
import { availableParallelism } from 'node:os';
import type { Plugin, UserConfig } from 'vite';
import { defineConfig, type TestProjectInlineConfiguration } from 'vitest/config';
import { givenFiles } from './src/cli/given-files.ts';
import { leanThree } from './vite.three.ts';

const page: UserConfig = {
  plugins: [leanThree()],
  build: {
    sourcemap: true,
    // Minified, not gzipped: three.js alone has 490 kB of that, 124 kB of this.
    chunkSizeWarningLimit: 700,
    // Fetched ahead by the HTML itself; the polyfill is for browsers older than WebGL 2.
    modulePreload: { polyfill: false },
    rolldownOptions: {
      // three.js changes seldom and is most of the script: a chunk of its own stays cached from version to version.
      // What the page begins with is one other, and what comes right after it a third: by themselves, modules that a
      // panel has too would be many small ones.
      output: {
        codeSplitting: {
          groups: [
            { name: 'three', test: /node_modules[\\/]three[\\/]/, priority: 1 },
            { name: 'page', tags: ['$initial'] },
            { name: 'rest', test: /ui[\\/]shell[\\/]mount\.ts/ },
          ],
        },
      },
    },
  },
};

const command: UserConfig = {
  build: {
    ssr: true,
    outDir: 'build',
    target: 'node20',
    copyPublicDir: false,
    rolldownOptions: {
      input: { marrow: 'src/cli/main.ts', samples: 'src/samples/make.ts' },
      output: { entryFileNames: '[name].js', chunkFileNames: 'shared/[name].js' },
    },
  },
  // One folder that runs without node_modules.
  ssr: { noExternal: true },
  plugins: [executable('build/marrow.js')],
};

/** `bin` in package.json points at it. */
function executable(file: string): Plugin {
  return { name: 'marrow-executable', closeBundle: () => chmodSync(file, 0o755) };
}

const QUICK = ['tests/**/*.test.ts'];
const DEEP = ['tests/**/*.deep.test.ts'];
const BROWSER = ['tests/e2e/**/*.test.ts'];

/** The projects run one after the other. @param order where among them, from 0 */
function tests(
  name: string,
  include: string[],
  order: number,
  own: TestProjectInlineConfiguration['test'],
): TestProjectInlineConfiguration {
  return {
    extends: true,
    test: {
      name,
      include,
      pool: 'threads',
      maxWorkers: availableParallelism(),
      sequence: { groupOrder: order },
      ...own,
    },
  };
}

export default defineConfig(({ mode }) => {
  const building = mode === 'cli' ? command : page;
  return {
    // Relative addresses: the built page works from any sub-path.
    base: './',
    ...building,
    worker: { format: 'es' },
    plugins: [givenFiles(), ...(building.plugins ?? [])],
    test: {
      reporters: ['default', './tests/helpers/count-reporter.ts'],
      projects: [
        // Quick, and the first to tell. No test leaves anything behind in what it imports: a worker imports it once.
        // Their properties try hundreds of cases, which takes a busy machine longer than it takes this one.
        tests('unit', QUICK, 0, { exclude: [...DEEP, ...BROWSER], isolate: false, testTimeout: 30_000 }),
        // The same of properties over many cases and files, which take longer than all the others together.
        // Processes instead of threads: some count the CPU time of theirs.
        tests('deep', DEEP, 1, { pool: 'forks', isolate: false, testTimeout: 60_000 }),
        // Two browsers draw in software: more than that get in each other's way. What a test polls for comes late where
        // the machine is busy: a second, as vitest has it, is too little.
        // Processes, so that their browsers end with them.
        tests('browser', BROWSER, 2, {
          pool: 'forks',
          isolate: false,
          maxWorkers: 2,
          testTimeout: 120_000,
          hookTimeout: 60_000,
          expect: { poll: { timeout: 15_000, interval: 100 } },
        }),
        // Benchmarks only, each alone in a process of its own.
        tests('bench', [], 3, { pool: 'forks', maxWorkers: 1 }),
      ],
    },
  };
});
