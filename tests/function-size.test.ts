/**
 * The size of functions: at most 80 lines, comments and all, and at most six parameters. Named here are kernels, whose
 * loops pass numbers and arrays without making objects; shaders; and texts that are one string.
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

function nameOf(node: Node, outer: string): string {
  if ('id' in node && node.id && 'name' in node.id) return String(node.id.name);
  if ('key' in node && node.key && 'name' in node.key) return String(node.key.name);
  return outer;
}

function sizesIn(file: string): Sized[] {
  const text = readFileSync(join(SRC, file), 'utf8');
  const found: Sized[] = [];
  const visit = (node: unknown, outer: string): void => {
    if (Array.isArray(node)) for (const one of node) visit(one, outer);
    if (typeof node !== 'object' || node === null || !('type' in node)) return;
    // Whatever has a type is a node of the tree.
    const part = node as ESTree.Node;
    const name = nameOf(part, outer);
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
  visit(parseSync(file, text).program, '');
  return found;
}

const sizes = readdirSync(SRC, { recursive: true, encoding: 'utf8' })
  .map((file) => file.replaceAll('\\', '/'))
  .filter((file) => /(?<!\.d)\.ts$/.test(file))
  .sort()
  .flatMap(sizesIn);

test('functions of src have at most 80 lines, but for kernels, shaders and texts that are named', () => {
  expect(sizes.length).toBeGreaterThan(10_000);
  expect(sizes.filter(({ lines }) => lines > MOST_LINES).map(({ called }) => called)).toEqual([...LONG].sort());
});

test('functions of src have at most six parameters, but for kernels', () => {
  const wide = sizes.filter(({ parameters }) => parameters > MOST_PARAMETERS).map(({ called }) => called);
  expect(wide.filter((called) => !KERNELS.some((kernel) => called.startsWith(kernel)))).toEqual([]);
  expect(KERNELS.filter((kernel) => !wide.some((called) => called.startsWith(kernel)))).toEqual([]);
});
