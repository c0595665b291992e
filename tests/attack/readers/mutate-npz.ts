/** Mutations of an array inside a `.npz`, which is zipped again: others rarely get behind its directory. */
import { unzipSync, zipSync } from 'fflate';
import type { Seed } from './corpus.ts';
import { mutated, pick, type Random } from './mutate.ts';

/** Undefined if the seed is no `.npz` with arrays. */
export function arrayMutated(seed: Seed, others: readonly Seed[], random: Random): Uint8Array<ArrayBuffer> | undefined {
  const files = filesOf(seed.bytes);
  const names = Object.keys(files);
  if (names.length === 0) return undefined;
  const name = pick(random, names);
  const arraysOf = ({ bytes }: Seed) =>
    Object.values(filesOf(bytes)).map((array): Seed => ({ subject: 'npy', bytes: array }));
  const own: Seed = { subject: 'npy', bytes: files[name] };
  const array = mutated(own, [own, ...arraysOf(pick(random, others))], random);
  return new Uint8Array(zipSync({ ...files, [name]: array }, { level: random() < 0.5 ? 0 : 6 }));
}

function filesOf(bytes: Uint8Array): Readonly<Record<string, Uint8Array>> {
  try {
    return unzipSync(bytes);
  } catch {
    return {};
  }
}
