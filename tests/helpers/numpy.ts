/** Files of numpy's arrays as they are opened, and made ones. */
import { zipSync } from 'fflate';
import { npyPieces } from '../../src/dataset/npy.ts';
import type { ImportedFile } from '../../src/files/imports.ts';
import { formatOf } from '../../src/files/readers.ts';
import type { ContentOf, WholeCharacter } from '../../src/model/files.ts';
import type { Take } from '../../src/model/takes/take.ts';

/** Reads a file as it is opened. */
export async function readArrays(name: string, bytes: Uint8Array): Promise<ImportedFile<ContentOf<'character'>>> {
  const read = await formatOf(name)?.imports?.({
    fileName: name,
    bytes: new Uint8Array(bytes),
    beside: async () => undefined,
  });
  if (!read) throw new Error(`${name} is not imported.`);
  const { value, ...rest } = read;
  return { ...rest, ...(value?.kind === 'character' && { value }) };
}

/** The only character of a file without errors, and its take. */
export async function characterIn(name: string, bytes: Uint8Array) {
  const { value, diagnostics } = await readArrays(name, bytes);
  if (!value) throw new Error(diagnostics.map(({ message }) => message).join(' '));
  const [character] = value.characters;
  return { character, take: takeIn(character), diagnostics };
}

function takeIn({ takes }: WholeCharacter): Take {
  if (takes.length !== 1) throw new Error(`Expected one take, found ${takes.length}.`);
  return takes[0];
}

/** An array for a file: its shape, and numbers or texts. */
export type MadeArray = readonly [shape: readonly number[], data: Float32Array | Float64Array | readonly string[]];

/** The bytes of a `.npy`. */
export function npyOf([shape, data]: MadeArray): Uint8Array {
  const isText = !ArrayBuffer.isView(data);
  const array = isText
    ? ({ name: '', type: 'text', shape, data } as const)
    : ({ name: '', type: 'float', shape, data } as const);
  return new Uint8Array(Buffer.concat([...npyPieces(array)]));
}

/** A `.npy` with any header. */
export function npyWith(header: string, content: Uint8Array, [major, minor] = [1, 0]): Uint8Array {
  const text = Buffer.from(header, major === 3 ? 'utf8' : 'latin1');
  const length = major === 1 ? Buffer.alloc(2) : Buffer.alloc(4);
  if (major === 1) length.writeUInt16LE(text.length);
  else length.writeUInt32LE(text.length);
  return new Uint8Array(
    Buffer.concat([Buffer.from('\x93NUMPY', 'latin1'), Buffer.of(major, minor), length, text, content]),
  );
}

/** The bytes of a `.npz` of such arrays, or of files as they are. */
export function npzOf(arrays: Readonly<Record<string, MadeArray | Uint8Array>>, level: 0 | 6 = 6): Uint8Array {
  const files = Object.entries(arrays).map(([name, array]) => [
    `${name}.npy`,
    array instanceof Uint8Array ? array : npyOf(array),
  ]);
  return zipSync(Object.fromEntries(files), { level });
}
