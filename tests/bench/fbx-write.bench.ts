/**
 * A capture as FBX, with a key a frame, against deflating the times and values of its keys alone, as FBX holds them, and
 * against its GLB, whose keys are fitted. Then 100,000 vertices with a take of keys: mostly deflating, against the same.
 */
import { zlibSync } from 'fflate';
import { bench, describe } from 'vitest';
import { writeFbx } from '../../src/export/fbx/write.ts';
import { DEFAULT_GLB } from '../../src/export/glb/options.ts';
import { writeGlb } from '../../src/export/glb/write.ts';
import type { Character } from '../../src/model/document.ts';
import { readCharacters, readGltf } from '../../src/package/import.ts';
import { chainGlb } from '../import/chain-glb.ts';
import { capture } from './capture.ts';

/** As the writer packs arrays. */
const LEVEL = 3;
const OPTIONS = { time: 0, iterations: 5, warmupTime: 0, warmupIterations: 1 };

const bytesOf = ({ buffer, byteOffset, byteLength }: Float32Array | Float64Array | BigInt64Array | Uint32Array) =>
  new Uint8Array(buffer, byteOffset, byteLength);

function compare(what: string, character: Character, arrays: readonly Uint8Array[]): void {
  describe(what, () => {
    bench('FBX', () => void writeFbx(character, { body: false }), OPTIONS);
    bench('its arrays deflated', () => arrays.forEach((array) => void zlibSync(array, { level: LEVEL })), OPTIONS);
    bench('GLB', () => void writeGlb(character, DEFAULT_GLB, true), OPTIONS);
  });
}

const SIZE = { joints: 25, frames: 3000, frameSeconds: 1 / 120 };
const { bvh, rows } = capture(169, SIZE);
const captured = await readCharacters([{ name: 'take.bvh', content: bvh }]);
const times = bytesOf(
  BigInt64Array.from(rows, (_, frame) => BigInt(Math.round(frame * SIZE.frameSeconds * 46186158000))),
);
const columns = rows[0].map((_, d) => bytesOf(Float32Array.from(rows, (row) => row[d])));
compare(
  `a capture of ${SIZE.frames} frames and ${SIZE.joints} joints`,
  captured.characters[0],
  columns.flatMap((column) => [times, column]),
);

const { character } = await readGltf(chainGlb({ joints: 30, takes: 1, keys: 20, vertices: 100_000 }));
if (!character) throw new Error('The GLB was not read.');
const [{ positions, normals, texcoords, triangles }] = character.skins;
const arrays = [positions, normals, texcoords, triangles].flatMap((list) => (list ? [bytesOf(list)] : []));
compare('a skin of 100,000 vertices with a take of keys', character, arrays);
