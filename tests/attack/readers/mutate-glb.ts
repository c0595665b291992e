/** Mutations of the JSON inside a GLB, whose lengths are made to fit again: others rarely get behind its header. */
import type { Seed } from './corpus.ts';
import { mutated, type Random } from './mutate.ts';

const HEADER = 20;

/** Undefined if the seed is no GLB. */
export function jsonMutated(seed: Seed, others: readonly Seed[], random: Random): Uint8Array<ArrayBuffer> | undefined {
  const { bytes } = seed;
  if (bytes.length < HEADER) return undefined;
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const end = HEADER + view.getUint32(12, true);
  if (end > bytes.length) return undefined;
  const jsonOf = (of: Seed): Seed => ({ subject: 'gltf', bytes: of.bytes.subarray(HEADER, end) });
  const json = mutated(jsonOf(seed), others.map(jsonOf), random);
  const padded = Math.ceil(json.length / 4) * 4;
  const rest = bytes.subarray(end);
  const made = new Uint8Array(HEADER + padded + rest.length);
  made.set(bytes.subarray(0, HEADER));
  made.fill(32, HEADER + json.length, HEADER + padded);
  made.set(json, HEADER);
  made.set(rest, HEADER + padded);
  const header = new DataView(made.buffer);
  header.setUint32(8, made.length, true);
  header.setUint32(12, padded, true);
  return made;
}
