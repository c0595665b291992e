/**
 * What src declares.
 *
 * The size of functions: at most 80 lines, comments and all, and at most six parameters. Named here are kernels, whose
 * loops pass numbers and arrays without making objects; shaders; and texts that are one string.
 *
 * Everything that the core exports has a doc comment: functions, classes with their public methods, types, constants.
 * Only a block that ends on the line above counts, since editors and API pages show no other. The first declaration of
 * overloads speaks for all of them, and one of two accessors for both.
 */
import { readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { type ESTree, parseSync } from 'vite';
import { expect, test } from 'vitest';

const SRC = fileURLToPath(new URL('../src/', import.meta.url));

const MOST_LINES = 80;
const MOST_PARAMETERS = 6;

const LONG: readonly string[] = [
  // Kernels.
  'evaluate/ik/chain.ts writeMatrices',
  'evaluate/samples/near-eulers.ts nearEuler',
  'export/glb/fit/exact-cubic.ts exactKeys',
  'formats/inflate.ts unpack',
  'formats/scan.ts scanNumbers',
  'math/ldlt.ts factorise',
  // A text.
  'teaching/kit/readme.ts readme',
  // Shaders.
  'view/pins/pin-marks.ts markMaterial',
  'view/scene/grid.ts gridMaterial',
];

/** Folders and files of kernels, called for each vertex, joint, sample or pixel. */
const KERNELS: readonly string[] = [
  'math/',
  'dataset/frame-quaternions.ts',
  'edit/hold/bake.ts',
  'edit/pose/fit-local.ts',
  'edit/samples/',
  'evaluate/ik/',
  'evaluate/motions/',
  'evaluate/plot/',
  'evaluate/retarget/fit.ts',
  'evaluate/rotations/',
  'evaluate/samples/',
  'evaluate/skin/',
  'export/glb/fit/',
  'export/shared/joint-nodes.ts',
  'import/fit-rotation.ts',
  'import/gltf/accessors.ts',
  'teaching/program/skin-run.ts',
  'ui/editors/curves/scene/trace.ts',
  'view/gizmo/pointer-measures.ts',
  'view/pins/pin-marks.ts',
  'view/scene/cover.ts',
  'view/scene/glyphs.ts',
  'view/skeleton/node-matrices.ts',
];

interface Sized {
  /** `file name`; the name is that of what the function is given to, if it has none. */
  readonly called: string;
  readonly lines: number;
  readonly parameters: number;
}

type Node = ESTree.Node | { readonly type?: undefined };

function nameIn(node: Node, outer: string): string {
  if ('id' in node && node.id && 'name' in node.id) return String(node.id.name);
  if ('key' in node && node.key && 'name' in node.key) return String(node.key.name);
  return outer;
}

function sizesIn(file: string, text: string, program: ESTree.Program): Sized[] {
  const found: Sized[] = [];
  const visit = (node: unknown, outer: string): void => {
    if (Array.isArray(node)) for (const one of node) visit(one, outer);
    if (typeof node !== 'object' || node === null || !('type' in node)) return;
    // Whatever has a type is a node of the tree.
    const part = node as ESTree.Node;
    const name = nameIn(part, outer);
    const isFunction =
      part.type === 'FunctionDeclaration' ||
      part.type === 'FunctionExpression' ||
      part.type === 'ArrowFunctionExpression';
    if (isFunction && part.body) {
      const lines = text.slice(part.start, part.end).split('\n').length;
      found.push({ called: `${file} ${name}`, lines, parameters: part.params.length });
    }
    for (const child of Object.values(part)) visit(child, name);
  };
  visit(program, '');
  return found;
}

const FOLDERS = [
  'math',
  'model',
  'formats',
  'evaluate',
  'edit',
  'dataset',
  'teaching',
  'import',
  'export',
  'files',
  'package',
];

/** A declaration that callers see. */
interface Exported {
  /** That of a method has its class before it: `Store.apply`. */
  readonly name: string;
  /** Offset of the declaration in its file, that of `export` where it has one. */
  readonly start: number;
}

function nameOf(node: { readonly type: string; readonly name?: unknown; readonly value?: unknown }): string {
  return String(node.type === 'Literal' ? node.value : node.name);
}

/** Public methods and accessors, besides constructors, which their class describes, and what overrides another's. */
function methodsOf(owner: string, body: ESTree.ClassBody): Exported[] {
  return body.body.flatMap((member) => {
    const isMethod = member.type === 'MethodDefinition' || member.type === 'TSAbstractMethodDefinition';
    if (!isMethod || member.kind === 'constructor' || member.override) return [];
    const isHidden = member.accessibility === 'private' || member.accessibility === 'protected';
    if (isHidden || member.key.type === 'PrivateIdentifier') return [];
    return [{ name: `${owner}.${nameOf(member.key)}`, start: member.start }];
  });
}

function exportsIn(program: ESTree.Program): Exported[] {
  const found = program.body.flatMap((statement): Exported[] => {
    if (statement.type !== 'ExportNamedDeclaration' || !statement.declaration) return [];
    const { declaration, start } = statement;
    switch (declaration.type) {
      case 'VariableDeclaration':
        return declaration.declarations.map(({ id }) => ({ name: nameOf(id), start }));
      case 'ClassDeclaration': {
        const name = declaration.id?.name ?? '';
        return [{ name, start }, ...methodsOf(name, declaration.body)];
      }
      default:
        return [{ name: 'id' in declaration && declaration.id ? nameOf(declaration.id) : '', start }];
    }
  });
  // The first of overloads and of two accessors.
  return found.filter(({ name }, i) => found.findIndex((one) => one.name === name) === i);
}

/** A tag alone doesn't say what a function gives, and nothing is above a comment on the page of an API. */
const WITHOUT_SUBJECT = /^\/\*\*[\s*]*(?:@|(?:Of|What|The same) )/;

function isDocumented(text: string, start: number): boolean {
  const above = text.lastIndexOf('\n', start);
  if (above < 0 || text.slice(above, start).trim() || !text.endsWith('*/', above)) return false;
  const comment = text.slice(text.lastIndexOf('/*', above), above);
  return comment.startsWith('/**') && !WITHOUT_SUBJECT.test(comment);
}

/** Undocumented exports as `file:line name`. */
function undocumentedIn(file: string, text: string, program: ESTree.Program): string[] {
  return exportsIn(program)
    .filter(({ start }) => !isDocumented(text, start))
    .map(({ name, start }) => `${file}:${text.slice(0, start).split('\n').length} ${name}`);
}

/** Each file is parsed once, which takes longer than all else here. */
const surveyed = readdirSync(SRC, { recursive: true, encoding: 'utf8' })
  .map((file) => file.replaceAll('\\', '/'))
  .filter((file) => /(?<!\.d)\.ts$/.test(file))
  .sort()
  .map((file) => {
    const text = readFileSync(join(SRC, file), 'utf8');
    const { program } = parseSync(file, text);
    return { file, sizes: sizesIn(file, text, program), undocumented: undocumentedIn(file, text, program) };
  });
const sizes = surveyed.flatMap((one) => one.sizes);

test('functions of src have at most 80 lines, but for kernels, shaders and texts that are named', () => {
  expect(sizes.length).toBeGreaterThan(10_000);
  expect(sizes.filter(({ lines }) => lines > MOST_LINES).map(({ called }) => called)).toEqual([...LONG].sort());
});

test('functions of src have at most six parameters, but for kernels', () => {
  const wide = sizes.filter(({ parameters }) => parameters > MOST_PARAMETERS).map(({ called }) => called);
  expect(wide.filter((called) => !KERNELS.some((kernel) => called.startsWith(kernel)))).toEqual([]);
  expect(KERNELS.filter((kernel) => !wide.some((called) => called.startsWith(kernel)))).toEqual([]);
});

test.each(FOLDERS)('everything that %s exports has a doc comment', (folder) => {
  const own = surveyed.filter(({ file }) => file.startsWith(`${folder}/`));
  expect(own.length).toBeGreaterThan(0);
  expect(own.flatMap(({ undocumented }) => undocumented)).toEqual([]);
});
