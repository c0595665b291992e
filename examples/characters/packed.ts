/** An example as the page opens it first: read already, in one short text. */
import { deepStrictEqual } from 'node:assert';
import { brotliCompressSync } from 'node:zlib';
import type { PackedExample } from '../../src/app/examples.ts';
import { packFiles, unpackFiles } from '../../src/io/packed-files.ts';
import { parse } from '../../src/worker/parse.ts';
import type { SampleListing } from './examples.ts';

/**
 * @param contents of the example's files, in their order
 * @throws if a file has problems, or would not be the same once it is unpacked
 */
export async function packedExample(
  { files, shows }: Pick<SampleListing, 'files' | 'shows'>,
  contents: readonly (string | Uint8Array<ArrayBuffer>)[],
): Promise<string> {
  // Paths as those of files that are fetched.
  const given = files.map((name, i) => ({ path: `samples/${name}`, blob: new Blob([contents[i]]) }));
  const read = await parse({ files: given }, () => {});
  if (read.diagnostics.length > 0 || read.files.length < files.length) throw new Error(`${files[0]} has problems.`);
  const sizeOf = (text: string) => brotliCompressSync(text).length;
  const packed: PackedExample = { ...(shows && { shows }), files: JSON.parse(packFiles(read.files, sizeOf)) };
  deepStrictEqual(unpackFiles(packed.files), read.files);
  return JSON.stringify(packed);
}
