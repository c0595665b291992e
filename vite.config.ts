/**
 * Five things are built from here: the page (`vite build`, into dist/), the command (`vite build --mode cli`, into
 * build/, which is not published with the page), the npm package (`vite build --mode package`, into build/package/; its
 * types are made by `tsconfig.package.json`), in it the element for pages without a bundler (`vite build --mode element`
 * and `--mode element-worker`, into build/package/element/), and the tests' projects.
 */
import { chmodSync, existsSync } from 'node:fs';
import { availableParallelism } from 'node:os';
import type { Plugin, UserConfig } from 'vite';
import { defineConfig, type TestProjectInlineConfiguration } from 'vitest/config';
import { draco } from './plugins/draco.ts';
import { givenFiles } from './plugins/given-files.ts';
import { manual } from './plugins/manual.ts';
import { offline } from './plugins/offline.ts';
import { openingSample } from './plugins/opening-sample.ts';
import { policy } from './plugins/policy.ts';
import { webPageScripts } from './plugins/web-page.ts';
import { firefoxPath } from './tests/helpers/firefox-path.ts';

const page: UserConfig = {
  plugins: [openingSample(), manual(), offline()],
  build: {
    sourcemap: true,
    // Size before gzip: three.js alone has 600 kB, 147 kB gzipped.
    chunkSizeWarningLimit: 700,
    // Preloaded by the HTML itself; the polyfill is for browsers without WebGL 2.
    modulePreload: { polyfill: false },
    rolldownOptions: {
      // three.js rarely changes and is most of the script: in its own chunk it stays cached across versions. The
      // initial script is another chunk, and what follows it a third: split automatically, modules shared with panels
      // would become many small chunks.
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
      input: { marrow: 'src/cli/main.ts', examples: 'examples/characters/make.ts' },
      output: { entryFileNames: '[name].js', chunkFileNames: 'shared/[name].js' },
    },
  },
  // A single folder that runs without node_modules.
  ssr: { noExternal: true },
  plugins: [executable('build/marrow.js')],
};

/** The entries of the package, each of them one of `exports` in package.json. */
const ENTRIES = ['model', 'formats', 'evaluate', 'import', 'export', 'dataset', 'viewer'];

/** Its file for Node asks for Node's modules, which pages don't have; what is used of it is the same in both. */
const FFLATE = { find: /^fflate$/, replacement: 'fflate/browser' };

const library: UserConfig = {
  build: {
    ssr: true,
    outDir: 'build/package',
    target: 'es2023',
    copyPublicDir: false,
    rolldownOptions: {
      input: {
        ...Object.fromEntries(ENTRIES.map((name) => [name, `src/package/${name}.ts`])),
        marrow: 'src/cli/main.ts',
      },
      // A peer of the viewer.
      external: /^three(\/|$)/,
      // A file for each module, so that bundlers leave out what a program doesn't use.
      output: {
        preserveModules: true,
        preserveModulesRoot: 'src',
        // npm packs no folder called node_modules.
        entryFileNames: ({ name }) => `${name.replace('node_modules/', 'bundled/')}.js`,
      },
    },
  },
  resolve: { alias: [FFLATE] },
  ssr: { noExternal: true },
  plugins: [executable('build/package/marrow.js'), apartFromWorker()],
};

/** The element for pages without a bundler: what most need is one file. */
const element: UserConfig = {
  ...standalone(['element'], 'marrow-viewer', 'src/package/viewer.ts'),
  plugins: [apartFromWorker()],
};
/** Its worker, also for bundlers. */
const elementWorker = standalone(['element', 'viewer'], 'worker', 'src/viewer/worker.ts');

const NOTICE = `/*! marrow-viewer: characters in any page. MIT License.
 * With parts of three.js (© three.js authors), fflate (© Arjun Barrett) and meshoptimizer (© Arseny Kapoulkine), MIT
 * License, and of Draco (© The Draco Authors), Apache License 2.0. */`;

/** @param folders of build/package/ */
function standalone(folders: readonly string[], name: string, entry: string): UserConfig {
  return {
    build: {
      ssr: true,
      emptyOutDir: false,
      target: 'es2023',
      minify: true,
      copyPublicDir: false,
      rolldownOptions: {
        input: { [name]: entry },
        output: folders.map((folder) => ({
          dir: `build/package/${folder}`,
          entryFileNames: '[name].js',
          chunkFileNames: 'parts/[name]-[hash].js',
          // After minifying, which removes what the packages say of themselves.
          postBanner: ({ isEntry }) => (isEntry ? NOTICE : ''),
          codeSplitting: { groups: [{ name, tags: ['$initial'] }] },
        })),
      },
    },
    resolve: { alias: [FFLATE] },
    ssr: { noExternal: true },
  };
}

/** The element finds its worker beside it, as a file that is built on its own. */
function apartFromWorker(): Plugin {
  return {
    name: 'marrow-apart-from-worker',
    enforce: 'pre',
    resolveId: (id) => (id === './worker.ts' ? { id: './worker.js', external: 'absolute' } : undefined),
  };
}

/** `bin` in package.json points at it. */
function executable(file: string): Plugin {
  return { name: 'marrow-executable', closeBundle: () => chmodSync(file, 0o755) };
}

const QUICK = ['tests/**/*.test.ts'];
const DEEP = ['tests/**/*.deep.test.ts'];
const MOCKED = ['tests/**/*.mocked.test.ts'];
const BROWSER = ['tests/e2e/**/*.test.ts'];
/** Tests that need the reference files, where these are not: `tests/helpers/shared.ts`. */
const WITHOUT_FILES = existsSync(new URL('../shared', import.meta.url)) ? [] : ['tests/**/*.shared.*'];

/**
 * Node reads the modules itself: through Vite that took half of the time of the quick tests, and each call of another
 * module's function a look-up. Only Vite puts mocks in place of modules. What properties make is soon garbage: in Node's
 * small space for the young, a tenth of the time of the deep tests went into copying what was still in use.
 */
const READ_BY_NODE = {
  execArgv: [
    '--min-semi-space-size=16',
    '--max-semi-space-size=64',
    ...['./tests/helpers/typescript.mjs', './tests/helpers/seed.ts'].flatMap((file) => [
      '--import',
      new URL(file, import.meta.url).href,
    ]),
  ],
  // Once for each process: as one of vitest's, the file would be read anew for every file of tests.
  setupFiles: [],
  experimental: { viteModuleRunner: false, nodeLoader: false },
};

/** Projects run one after the other. @param order from 0 */
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
      // Processes instead of threads: some tests measure their CPU time, and browsers end with the process.
      pool: 'forks',
      // Tests leave no global state, so a worker imports modules once.
      isolate: false,
      maxWorkers: availableParallelism(),
      setupFiles: ['./tests/helpers/seed.ts'],
      // On a busy machine, polled conditions need longer than vitest's default of a second.
      expect: { poll: { timeout: 15_000, interval: 50 } },
      sequence: { groupOrder: order },
      ...own,
    },
  };
}

export default defineConfig(({ mode }) => {
  const building =
    {
      cli: command,
      package: library,
      element,
      'element-worker': elementWorker,
    }[mode] ?? page;
  return {
    // Relative addresses: the built page works under any path.
    base: './',
    ...building,
    // Examples in HTML name files that are beside them elsewhere.
    optimizeDeps: { entries: ['index.html'] },
    worker: { format: 'es', plugins: () => [draco(), webPageScripts()] },
    plugins: [givenFiles(), draco(), policy(), webPageScripts(), ...(building.plugins ?? [])],
    test: {
      // What passes is only counted where nobody watches.
      reporters: [process.stdout.isTTY ? 'default' : 'minimal', './tests/helpers/count-reporter.ts'],
      projects: [
        // Quick, and reported first. Properties try hundreds of cases, which takes longer on a busy machine.
        tests('unit', QUICK, 0, {
          ...READ_BY_NODE,
          exclude: [...DEEP, ...MOCKED, ...BROWSER, ...WITHOUT_FILES],
          testTimeout: 30_000,
        }),
        // Properties over many cases and files, which take longer than all other tests together.
        tests('deep', DEEP, 1, { ...READ_BY_NODE, exclude: WITHOUT_FILES, testTimeout: 60_000 }),
        tests('mocked', MOCKED, 1, { testTimeout: 60_000 }),
        // Two browsers at most, since they draw in software. A browser under load may lose an event to a frame: a second
        // try decides, and the run names each test that needed it.
        tests('browser', BROWSER, 2, {
          ...READ_BY_NODE,
          exclude: [...(firefoxPath() ? [] : ['tests/e2e/firefox.test.ts']), ...WITHOUT_FILES],
          retry: 1,
          maxWorkers: 2,
          testTimeout: 120_000,
          hookTimeout: 60_000,
        }),
        // Benchmarks only, each alone in its own process.
        tests('bench', [], 3, { isolate: true, maxWorkers: 1 }),
      ],
    },
  };
});
