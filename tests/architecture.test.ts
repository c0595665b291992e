/**
 * Which folder of `src/` may import which, read off the imports themselves: the arrows that keep the core free of page
 * and Node, and the view unable to edit. Types count: a type that points the wrong way is a hidden cycle.
 */
import { readdirSync, readFileSync } from 'node:fs';
import { dirname, join, posix } from 'node:path';
import { fileURLToPath } from 'node:url';
import { describe, expect, it } from 'vitest';

const SRC = fileURLToPath(new URL('../src/', import.meta.url));
const BASE = ['model', 'math'];

/** Besides itself. A file that lies in `src/` itself (`main.ts`) wires everything, and nobody imports it. */
const MAY_IMPORT: Readonly<Record<string, readonly string[]>> = {
  math: [],
  model: ['math'],
  formats: BASE,
  evaluate: BASE,
  // Comparing with other programs, and naming their mistakes; it never learns which file numbers came from.
  teaching: ['evaluate', ...BASE],
  edit: ['evaluate', ...BASE],
  // Takes by the hundred: what looks wrong in them, and the list of what a person found.
  review: ['evaluate', ...BASE],
  // Whole characters of other programs, glTF and FBX: read, and written.
  import: ['formats', 'evaluate', ...BASE],
  export: ['formats', 'evaluate', ...BASE],
  // The numbers of takes, for files that other programs learn from.
  dataset: ['edit', 'evaluate', ...BASE],
  // Opening and saving, the same for page and command.
  files: ['import', 'export', 'formats', 'evaluate', 'edit', ...BASE],
  worker: ['teaching/kit', 'files', 'import', 'export', 'review', 'teaching', 'formats', 'evaluate', ...BASE],
  io: ['worker', 'formats', ...BASE],
  view: ['evaluate', ...BASE],
  // The service worker.
  offline: [],
  // Widgets that any page could have.
  'ui/widgets': [...BASE],
  // What panels share: the workbench, settings, actions found by their ids.
  'ui/state': ['ui/widgets', 'view', 'import', 'export', 'files', 'edit', 'review', 'teaching', 'evaluate', ...BASE],
  // A folder a panel or tool, with its own actions.
  'ui/editors': ['ui/state', 'ui/widgets', 'view', 'edit', 'review', 'teaching', 'evaluate', ...BASE],
  // What puts them together: layout, menu bar, the one list of actions, dialogs.
  'ui/shell': [
    'ui/styles',
    'ui/editors',
    'ui/state',
    'ui/widgets',
    'view',
    'import',
    'export',
    'files',
    'edit',
    'evaluate',
    ...BASE,
  ],
  // Files that tell mistakes apart, with their answers.
  'teaching/kit': ['files', 'teaching', 'formats', 'evaluate', ...BASE],
  // The element of other pages.
  viewer: ['ui/widgets', 'view', 'io', 'worker', 'files', 'formats', 'edit', 'evaluate', ...BASE],
  // The entries of the npm package.
  package: ['viewer', 'worker', 'dataset', 'import', 'export', 'files', 'formats', 'edit', 'evaluate', ...BASE],
  cli: [
    'dataset',
    'import',
    'export',
    'teaching/kit',
    'files',
    'review',
    'teaching',
    'formats',
    'evaluate',
    'edit',
    ...BASE,
  ],
  // What `main.ts` wires together, where it takes more than a line.
  app: [
    'import',
    'export',
    'teaching/kit',
    'teaching',
    'review',
    'ui/shell',
    'ui/editors',
    'ui/state',
    'ui/widgets',
    'view',
    'io',
    'offline',
    'viewer',
    'worker',
    'files',
    'formats',
    'edit',
    'evaluate',
    ...BASE,
  ],
};

/** Packages, and which folders may use them. `node:` stands for all of Node. */
const PACKAGES: Readonly<Record<string, readonly string[]>> = {
  three: ['view', 'io'],
  'idb-keyval': ['io'],
  mediabunny: ['io'],
  gifenc: ['io'],
  'lil-gui': ['ui/widgets', 'ui/editors'],
  '@codemirror': ['ui/editors'],
  fflate: ['formats', 'import', 'export', 'files', 'io', 'app'],
  // Decoders of compressed glTF.
  meshoptimizer: ['import'],
  'virtual:opening-sample': ['app'],
  'virtual:draco': ['import'],
  'virtual:web-page': ['worker', 'cli'],
  'node:': ['cli'],
};

interface Import {
  /** Relative to `src/`, `/` between folders. */
  readonly file: string;
  /** As written. */
  readonly specifier: string;
}

const files = readdirSync(SRC, { recursive: true, encoding: 'utf8' })
  .map((file) => file.replaceAll('\\', '/'))
  .filter((file) => /(?<!\.d)\.ts$/.test(file))
  .sort();

/** `import … from 'x'`, `export … from 'x'`, `import 'x'`, `import('x')`, `new URL('./x.ts', import.meta.url)`. */
const SPECIFIER =
  /(?:^|[\s;}])(?:import|export)\s(?:[^'"`;]*?\sfrom\s*)?['"]([^'"]+)['"]|\bimport\(\s*['"]([^'"]+)['"]|new URL\(\s*['"]([^'"]+\.ts)['"],\s*import\.meta/g;

function importsOf(file: string): Import[] {
  const text = readFileSync(join(SRC, file), 'utf8').replace(/\/\*[\s\S]*?\*\/|^\s*\/\/.*$/gm, '');
  return [...text.matchAll(SPECIFIER)].map((m) => ({ file, specifier: m[1] ?? m[2] ?? m[3] ?? '' }));
}

const imports = files.flatMap(importsOf);
const inside = imports
  .filter(({ specifier }) => specifier.startsWith('.'))
  .map(({ file, specifier }) => ({ file, to: posix.join(dirname(file), specifier.replace(/\?.*$/, '')) }));
/** The folder that the arrows are about: `view`, or one with arrows of its own, `ui/widgets`; empty for `src/` itself. */
function folderOf(file: string): string {
  const [outer = '', inner] = dirname(file).split('/');
  if (outer === '.') return '';
  const both = `${outer}/${inner}`;
  return outer === 'ui' || Object.hasOwn(MAY_IMPORT, both) ? both : outer;
}

describe('the folders of src', () => {
  it('the folders of src are all accounted for', () => {
    const found = new Set(files.map(folderOf).filter((folder) => folder !== ''));
    expect([...found].filter((folder) => !Object.hasOwn(MAY_IMPORT, folder))).toEqual([]);
  });

  it('import along the arrows only', () => {
    const wrong = inside.filter(({ file, to }) => {
      const [from, target] = [folderOf(file), folderOf(to)];
      return from !== '' && from !== target && !MAY_IMPORT[from]?.includes(target);
    });
    expect(wrong.map(({ file, to }) => `${file} imports ${to}`)).toEqual([]);
  });

  it('the folders of src in ui never import each other both ways', () => {
    const pairs = new Set(
      inside
        .filter(({ file, to }) => file.startsWith('ui/') && to.startsWith('ui/') && dirname(file) !== dirname(to))
        .map(({ file, to }) => `${dirname(file)} and ${dirname(to)}`),
    );
    const back = (pair: string) => pair.split(' and ').reverse().join(' and ');
    expect([...pairs].filter((pair) => pair < back(pair) && pairs.has(back(pair)))).toEqual([]);
  });

  it('the folders of src never import the tests, nor anything else outside', () => {
    expect(inside.filter(({ to }) => to.startsWith('..')).map(({ file, to }) => `${file} imports ${to}`)).toEqual([]);
  });

  it('the folders of src have at most 30 files each, besides folders', () => {
    const counts = new Map<string, number>();
    for (const file of readdirSync(SRC, { recursive: true, encoding: 'utf8' })) {
      const folder = dirname(file.replaceAll('\\', '/'));
      if (/\.\w+$/.test(file)) counts.set(folder, (counts.get(folder) ?? 0) + 1);
    }
    expect([...counts].filter(([, count]) => count > 30)).toEqual([]);
    expect(counts.get('ui/styles')).toBeGreaterThan(10);
  });

  it('use packages only where they belong', () => {
    const outside = imports.filter(({ specifier }) => !specifier.startsWith('.'));
    const wrong = outside.filter(({ file, specifier }) => {
      const name = specifier.startsWith('node:') ? 'node:' : (specifier.split('/')[0] ?? specifier);
      return !(PACKAGES[name] ?? []).includes(folderOf(file));
    });
    expect(wrong.map(({ file, specifier }) => `${file} imports ${specifier}`)).toEqual([]);
  });
});

describe('the files of src', () => {
  it('import files that are there, by their full names', () => {
    const known = new Set(files);
    const scripts = inside.filter(({ to }) => !/\.(css|svg|json|d\.ts)$/.test(to));
    expect(scripts.filter(({ to }) => !known.has(to)).map(({ file, to }) => `${file} imports ${to}`)).toEqual([]);
  });

  it('import each other in no circle', () => {
    const next = new Map<string, string[]>(files.map((file) => [file, []]));
    for (const { file, to } of inside) next.get(file)?.push(to);
    expect(findCircle(next)).toEqual([]);
  });

  it('files of ui and view set tooltips by setTooltip, for neither focus nor touch shows a native title', () => {
    const native =
      /setAttribute\([^)]*'title'|\.title = |element\([^;]*?\{[^{}]*\btitle\b[,:]|button\([^;]*?\{[^{}]*\btitle\b[,:]/;
    const wrong = files.filter(
      (file) => /^(ui|view)\//.test(file) && native.test(readFileSync(join(SRC, file), 'utf8')),
    );
    expect(wrong).toEqual([]);
    expect(native.test("element('p', { class: 'a', title: text }, 'b')")).toBe(true);
  });

  it('errors of src that users read have one base, and only that of programmers has none', () => {
    const bare = files.filter((file) =>
      /\bextends (Type|Range|Syntax)?Error\b/.test(readFileSync(join(SRC, file), 'utf8')),
    );
    expect(bare).toEqual(['evaluate/ik/pins.ts', 'model/user-error.ts']);
  });

  it('src exports no function that no other file names', () => {
    const texts = new Map<string, string>();
    for (const folder of ['src/', 'tests/', 'plugins/', 'examples/']) {
      const at = fileURLToPath(new URL(`../${folder}`, import.meta.url));
      for (const file of readdirSync(at, { recursive: true, encoding: 'utf8' })) {
        if (file.endsWith('.ts')) texts.set(folder + file.replaceAll('\\', '/'), readFileSync(join(at, file), 'utf8'));
      }
    }
    texts.set('vite.config.ts', readFileSync(fileURLToPath(new URL('../vite.config.ts', import.meta.url)), 'utf8'));
    const filesNaming = new Map<string, number>();
    for (const text of texts.values()) {
      for (const name of new Set(text.match(/[\w$]+/g))) filesNaming.set(name, (filesNaming.get(name) ?? 0) + 1);
    }
    const exported = [...texts].flatMap(([file, text]) =>
      [...text.matchAll(/^export (?:async )?function\*? ([\w$]+)/gm)].map(([, name]) => ({ file, name })),
    );
    expect(exported.length).toBeGreaterThan(1000);
    const unused = exported.filter(({ file, name }) => file.startsWith('src/') && filesNaming.get(name) === 1);
    expect(unused.map(({ file, name }) => `${file} exports ${name}`)).toEqual([]);
  });

  it('the files of src can be read: the scan finds imports of every form', () => {
    // Guards the expression above: a scan that finds nothing would pass everything.
    expect(inside.length).toBeGreaterThan(files.length);
    expect(inside).toContainEqual({ file: 'model/document.ts', to: 'math/vec3.ts' });
  });
});

describe('what panels write', () => {
  it('panels write what may be there already by functions that compare, since browsers take an equal write for a change', () => {
    // Where elements are made.
    const apart = ['ui/widgets/dom.ts', 'ui/widgets/icons.ts'];
    const direct = /\.(hidden|disabled|placeholder|className)\s=[^=]|\.setAttribute\(/;
    const found = files
      .filter((file) => file.startsWith('ui/') && !apart.includes(file))
      .filter((file) => {
        return direct.test(readFileSync(join(SRC, file), 'utf8'));
      });
    expect(found).toEqual([]);
    for (const file of apart) expect(readFileSync(join(SRC, file), 'utf8')).toMatch(direct);
  });
});

/** The files of the first circle found, in order; empty if there is none. */
function findCircle(next: ReadonlyMap<string, readonly string[]>): string[] {
  const done = new Set<string>();
  const path: string[] = [];
  const visit = (file: string): string[] | undefined => {
    if (done.has(file)) return undefined;
    const at = path.indexOf(file);
    if (at >= 0) return [...path.slice(at), file];
    path.push(file);
    for (const to of next.get(file) ?? []) {
      const circle = visit(to);
      if (circle) return circle;
    }
    path.pop();
    done.add(file);
    return undefined;
  };
  for (const file of next.keys()) {
    const circle = visit(file);
    if (circle) return circle;
  }
  return [];
}
