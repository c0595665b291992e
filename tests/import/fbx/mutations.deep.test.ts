/** Damaged FBX files: always a result or a diagnostic, never an exception, and never more work than the file is worth. */
import fc from 'fast-check';
import { expect, it } from 'vitest';
import { readFbx } from '../../../src/import/fbx/read.ts';
import { describeShared, sharedBytes } from '../../helpers/shared.ts';
import { randomFbx } from './random-fbx.ts';
import { fbxBytes, fbxText } from './write-fbx.ts';

const SMALL = [
  'maya_game_sausage_7500_binary_combined',
  'maya_anim_layers_7500_ascii',
  'maya_blend_shape_cube_7700_binary',
  'maya_pivot_offset_7700_ascii',
];

/** A change of some bytes: overwritten, cut out, doubled, or the end cut off. */
const damage = fc.record({
  at: fc.double({ min: 0, max: 1, noNaN: true }),
  length: fc.integer({ min: 1, max: 40 }),
  kind: fc.constantFrom('overwrite', 'overwrite', 'overwrite', 'cut', 'double', 'end'),
  bytes: fc.uint8Array({ minLength: 1, maxLength: 8 }),
});

function damaged(
  bytes: Uint8Array,
  changes: readonly (typeof damage extends fc.Arbitrary<infer T> ? T : never)[],
): Uint8Array {
  let own = Uint8Array.from(bytes);
  for (const { at, length, kind, bytes: written } of changes) {
    const from = Math.floor(at * own.length);
    const rest = own.subarray(Math.min(own.length, from + length));
    if (kind === 'overwrite') own.set(written.subarray(0, own.length - from), from);
    else if (kind === 'cut') own = Uint8Array.from([...own.subarray(0, from), ...rest]);
    else if (kind === 'double') own = Uint8Array.from([...own.subarray(0, from + length), ...own.subarray(from)]);
    else own = own.slice(0, from);
  }
  return own;
}

function expectResult(bytes: Uint8Array): void {
  const { value, diagnostics } = readFbx('damaged.fbx', new Uint8Array(bytes));
  const errors = diagnostics.filter(({ severity }) => severity === 'error');
  expect(value === undefined).toBe(errors.length > 0);
  for (const mesh of value?.meshes ?? []) {
    const count = mesh.positions.length / 3;
    expect(mesh.positions.every(Number.isFinite)).toBe(true);
    for (const { triangles } of mesh.surfaces) expect(triangles.every((vertex) => vertex < count)).toBe(true);
    for (const { positions } of mesh.targets) expect(positions.indices.every((vertex) => vertex < count)).toBe(true);
  }
}

describeShared('damaged public FBX files', () => {
  for (const name of SMALL) {
    it(`${name} with any bytes changed is read or refused`, () => {
      const bytes = sharedBytes(`data/fbx/${name}.fbx`);
      fc.assert(
        fc.property(fc.array(damage, { minLength: 1, maxLength: 3 }), (changes) =>
          expectResult(damaged(bytes, changes)),
        ),
        { numRuns: 125 },
      );
    });
  }
});

it('random FBX files with any bytes changed are read or refused', () => {
  fc.assert(
    fc.property(randomFbx, fc.boolean(), fc.array(damage, { minLength: 1, maxLength: 3 }), (fbx, isText, changes) => {
      const bytes = isText ? new TextEncoder().encode(fbxText(fbx)) : fbxBytes(fbx);
      expectResult(damaged(bytes, changes));
    }),
    { numRuns: 50 },
  );
});
