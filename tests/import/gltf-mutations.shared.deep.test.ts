/** Damaged glTF files: a character or a diagnostic, never an exception. */
import fc from 'fast-check';
import { expect, it } from 'vitest';
import { importFile } from '../../src/files/imports.ts';
import { readContainer } from '../../src/import/gltf/container.ts';
import type { Import } from '../../src/import/imported.ts';
import { describeShared, sharedBytes } from '../helpers/shared.ts';
import { glbOf } from './make-gltf.ts';

const SMALL = [
  'made-odd.glb',
  'made-shared-joints.glb',
  'cs-morph/01_cs_morph.gltf',
  'sparse-two-primitives/23_multi_prim_vertex_attribute.gltf',
];

/** Digits of the JSON are what indices and counts are made of. */
const damage = fc.record({
  at: fc.double({ min: 0, max: 1, noNaN: true }),
  written: fc.oneof(
    fc.constantFrom('9', '0', '-1', '1e9', '[]', '{}', 'null', '"x"', ',', '}'),
    fc.string({ minLength: 1, maxLength: 3 }),
  ),
  isCut: fc.boolean(),
});

async function expectResult(bytes: Uint8Array<ArrayBuffer>, beside: Import['beside']): Promise<void> {
  const { value, diagnostics } = await importFile('gltf', { fileName: 'damaged.glb', bytes, beside });
  expect(value === undefined).toBe(diagnostics.some(({ severity }) => severity === 'error'));
  for (const { skins, skeleton } of value?.characters ?? []) {
    for (const { positions, normals, bindings, attachments, triangles } of skins) {
      for (const values of [positions, normals, bindings, attachments?.weights]) {
        expect(values?.every(Number.isFinite) ?? true).toBe(true);
      }
      expect(triangles.every((v) => v < positions.length / 3)).toBe(true);
      expect(attachments?.joints.every((j) => j < skeleton.joints.length)).toBe(true);
    }
  }
}

/** All numbers, texts and lists of a JSON: the object, and the name in it. */
function places(value: object): readonly (readonly [object, string])[] {
  return Object.entries(value).flatMap(([name, item]): (readonly [object, string])[] =>
    typeof item === 'object' && item !== null ? [[value, name], ...places(item)] : [[value, name]],
  );
}

const hostile = fc.oneof(fc.constantFrom(-1, 1e9, 0.5, 'x', null, [], {}, [0], 'VEC3', 5125, 1e308), fc.nat(12));

describeShared('damaged public glTF files', () => {
  it.each(SMALL)('%s with any of it changed is read or refused', async (file) => {
    const path = `data/gltf/${file}`;
    const folder = path.slice(0, path.lastIndexOf('/') + 1);
    const original = sharedBytes(path);
    const beside = async (name: string) => {
      if (name !== file.slice(file.indexOf('/') + 1).replace('.gltf', '.bin')) return undefined;
      return { bytes: new Uint8Array(sharedBytes(folder + name)), source: { name, path: name, bytes: 0 } };
    };
    // Half of the changes in the JSON, wherever it ends.
    const jsonEnd = file.endsWith('.gltf') ? original.length : 20 + new DataView(original.buffer).getUint32(12, true);
    await fc.assert(
      fc.asyncProperty(fc.array(damage, { minLength: 1, maxLength: 3 }), fc.boolean(), async (changes, isJson) => {
        let bytes = new Uint8Array(original);
        for (const { at, written, isCut } of changes) {
          const from = Math.floor(at * (isJson ? jsonEnd : bytes.length));
          if (isCut && at > 0.9) bytes = bytes.slice(0, from);
          else bytes.set(new TextEncoder().encode(written).subarray(0, bytes.length - from), from);
        }
        await expectResult(bytes, beside);
      }),
      { numRuns: 50 },
    );
  });

  it.each(SMALL)('%s with any values of its JSON changed is read or refused', async (file) => {
    const path = `data/gltf/${file}`;
    const folder = path.slice(0, path.lastIndexOf('/') + 1);
    const { document, binary } = readContainer(new Uint8Array(sharedBytes(path)));
    const text = JSON.stringify(document.root);
    const beside = async (name: string) => {
      if (name !== file.slice(file.indexOf('/') + 1).replace('.gltf', '.bin')) return undefined;
      return { bytes: new Uint8Array(sharedBytes(folder + name)), source: { name, path: name, bytes: 0 } };
    };
    await fc.assert(
      fc.asyncProperty(fc.array(fc.tuple(fc.nat(), hostile), { minLength: 1, maxLength: 3 }), async (changes) => {
        const json: Record<string, unknown> = JSON.parse(text);
        for (const [at, value] of changes) {
          const all = places(json);
          const [object, name] = all[at % all.length];
          Reflect.set(object, name, value);
        }
        await expectResult(glbOf({ json, buffers: [binary ?? new Uint8Array(0)] }), beside);
      }),
      { numRuns: 75 },
    );
  });
});
