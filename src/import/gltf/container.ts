/**
 * The outer form of a glTF file:
 *
 *     .gltf     JSON
 *     .glb      "glTF" version length, then chunks: length type bytes; the first is JSON, the second may be "BIN"
 *
 * Told by content, so that either extension may hold either.
 */
import { ImportError } from '../imported.ts';
import { Document, objectOf, shown, textOf } from './json.ts';

const MAGIC = 0x46546c67;
const JSON_CHUNK = 0x4e4f534a;
const BIN_CHUNK = 0x004e4942;

/** The JSON of a file, and its binary chunk. */
export interface Container {
  readonly document: Document;
  /** The file's own binary chunk. */
  readonly binary?: Uint8Array<ArrayBuffer>;
}

/**
 * Reads a `.gltf` or `.glb`, told by content.
 * @throws ImportError for anything else, and for another version than 2
 */
export function readContainer(bytes: Uint8Array<ArrayBuffer>): Container {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  if (bytes.length >= 4 && view.getUint32(0, true) === MAGIC) return readChunks(bytes, view);
  return { document: readJson(bytes) };
}

function readChunks(bytes: Uint8Array<ArrayBuffer>, view: DataView): Container {
  if (bytes.length < 20) {
    throw new ImportError('file-truncated', `Expected a header and a chunk, found only ${bytes.length} bytes.`);
  }
  const version = view.getUint32(4, true);
  if (version !== 2) throw wrongVersion(String(version));
  const length = view.getUint32(8, true);
  if (length > bytes.length) {
    const message = `The file says that it has ${length} bytes, but it ends after ${bytes.length}. It may have been cut off: copy or export it again.`;
    throw new ImportError('file-truncated', message);
  }
  let json: Uint8Array<ArrayBuffer> | undefined;
  let binary: Uint8Array<ArrayBuffer> | undefined;
  for (let at = 12; at + 8 <= length; ) {
    const size = view.getUint32(at, true);
    const type = view.getUint32(at + 4, true);
    if (at + 8 + size > length) {
      throw new ImportError('file-truncated', `A chunk at byte ${at} has ${size} bytes and reaches past the end.`);
    }
    const content = bytes.subarray(at + 8, at + 8 + size);
    if (type === JSON_CHUNK) json ??= content;
    else if (type === BIN_CHUNK) binary ??= content;
    // Chunks are padded to four bytes, which some programs don't count in their length.
    at += 8 + size + ((4 - (size % 4)) % 4);
  }
  if (!json) throw new ImportError('json-missing', 'Expected a chunk of JSON, found none.');
  return { document: readJson(json), ...(binary && { binary }) };
}

function readJson(bytes: Uint8Array): Document {
  let parsed: unknown;
  try {
    parsed = JSON.parse(new TextDecoder().decode(bytes));
  } catch (error) {
    const reason = error instanceof Error ? error.message : String(error);
    throw new ImportError('json-invalid', `Expected glTF: JSON or a GLB file. The JSON can't be read: ${reason}.`);
  }
  const root = objectOf(parsed);
  const asset = objectOf(root?.asset);
  if (!root || !asset) throw new ImportError('gltf-expected', 'Expected glTF, found JSON without "asset".');
  const version = textOf(asset.version) ?? shown(asset.version);
  if (!version.startsWith('2.')) throw wrongVersion(version);
  return new Document(root);
}

function wrongVersion(version: string): ImportError {
  const message = `Expected glTF version 2.0, found ${version}. Open it in a program that reads it, such as Blender, and export glTF 2.0.`;
  return new ImportError('version-unknown', message);
}
