/** Files as the page's worker reads them. */
import { formatOf } from '../../src/files/readers.ts';
import { sha256 } from '../../src/formats/sha256.ts';
import type { ParsedFile } from '../../src/model/files.ts';

/**
 * A file whose whole content is given.
 *
 * @throws Error if it can't be read
 */
export function parsed(path: string, given: string | Uint8Array): ParsedFile {
  const bytes = typeof given === 'string' ? new TextEncoder().encode(given) : given;
  const name = path.slice(path.lastIndexOf('/') + 1);
  const reader = formatOf(name)?.reader(name, bytes.length);
  reader?.feed(bytes);
  const content = reader?.end().value;
  if (!content) throw new Error(`${path} can't be read.`);
  return { ...content, source: { name, path, bytes: bytes.length }, sha256: sha256(bytes) };
}
