/** `flattened` in JSON beside a take: the plain file, and the hash of the bytes that were saved with the JSON. */
import type { FlattenedFile } from '../../model/takes/layers-file.ts';
import type { JsonValue } from './read.ts';

/** Reads the field's value. */
export function readFlattened(value: JsonValue): FlattenedFile {
  const object = value.object();
  const file = object.field('file').text();
  const hash = object.field('sha256');
  const sha256 = hash.text();
  if (!/^[0-9a-f]{64}$/i.test(sha256)) hash.wrong('64 hex digits');
  return { file, sha256: sha256.toLowerCase(), ...object.others() };
}

/** The field's value, as it is written; undefined for none. */
export function flattenedValue(flattened: FlattenedFile | undefined): unknown {
  return flattened && { file: flattened.file, sha256: flattened.sha256, ...flattened.others };
}
