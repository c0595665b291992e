/**
 * Three things are built from here: the page (`vite build`, into dist/), the command (`vite build --mode cli`, into
 * build/, which is not published with the page), and the tests' projects.
 */
import { chmodSync } from 'node:fs';
import type { Plugin, UserConfig } from 'vite';
import { defineConfig } from 'vitest/config';
import { givenFiles } from './src/cli/given-files.ts';

const page: UserConfig = {
  build: {
    sourcemap: true,
    // Minified, not gzipped: three.js alone has 590 kB of that, 146 kB of this.
    chunkSizeWarningLimit: 700,
    // Fetched ahead by the HTML itself; the polyfill is for browsers older than WebGL 2.
    modulePreload: { polyfill: false },
    rolldownOptions: {
      // three.js changes seldom and is most of the script: a chunk of its own stays cached from version to version.
      // What the page begins with is one other: by themselves, modules that a panel has too would be many small ones.
      output: {
        codeSplitting: {
          groups: [
            { name: 'three', test: /node_modules[\\/]three[\\/]/, priority: 1 },
            { name: 'page', tags: ['$initial'] },
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
        {
          extends: true,
          test: {
            name: 'unit',
            include: ['tests/**/*.test.ts'],
            exclude: ['tests/e2e/**'],
            sequence: { groupOrder: 0 },
            // Properties try hundreds of cases, which takes a busy machine longer than it takes this one.
            testTimeout: 30_000,
          },
        },
        {
          extends: true,
          test: {
            name: 'browser',
            include: ['tests/e2e/**/*.test.ts'],
            // One browser at a time, after everything else: some of these tests look at how long things take.
            sequence: { groupOrder: 1 },
            fileParallelism: false,
            testTimeout: 120_000,
            hookTimeout: 60_000,
          },
        },
      ],
    },
  };
});
