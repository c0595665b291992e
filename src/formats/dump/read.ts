/**
 * Dumps: what other programs print, read for comparison. Told by content:
 *
 *     JSON     {"time": 1.5, "world": [[16 numbers], …]}, and whatever else has such keys
 *     PLY      ascii: x y z and nx ny nz of the vertices
 *     OBJ      lines `v x y z` and `vn x y z`
 *     text     numbers in rows, with commas, brackets, names, indices and headings around them
 *
 * A file without such numbers gives a dump without blocks: a readme beside a character is no error.
 */
import type { Dump } from '../../model/dump.ts';
import { stemOfName } from '../grammar.ts';
import { bytesReader, type Reader, type ReadResult, readWhole } from '../reader.ts';
import type { Report } from '../report.ts';
import { Blocks } from './blocks.ts';
import { withDecimalPoints } from './decimal-commas.ts';
import { readJson } from './json.ts';
import { readObj, readPly } from './meshes.ts';
import { readText } from './text.ts';

/**
 * A reader of dumps in any of these forms, told by content. A file without numbers of a character gives a dump without
 * blocks, and no error.
 */
export function dumpReader(fileName: string): Reader<Dump> {
  return bytesReader(fileName, (bytes, report) => decode(fileName, bytes, report));
}

/** Reads a whole dump. */
export function readDump(bytes: Uint8Array | string, fileName: string): ReadResult<Dump> {
  return readWhole(dumpReader(fileName), bytes);
}

function decode(fileName: string, bytes: Uint8Array, report: Report): Dump | undefined {
  const text = decodeText(bytes);
  const blocks = new Blocks();
  if (/^\s*ply\s*$/m.test(text.slice(0, 64).split(/[\r\n]/, 1)[0])) readPly(text, blocks, report);
  else if (isBinary(bytes))
    report.warn('dump-binary', 'Expected text with numbers, found binary data.', { line: 1, column: 1 }, 'skipped');
  else if (!readJson(text, blocks)) {
    if (/^[ \t]*vn?[ \t]+[-+.\d]\S*[ \t]+[-+.\d]\S*[ \t]+[-+.\dn]/m.test(text)) readObj(text, blocks, report);
    else readText(withDecimalPoints(text), blocks, report);
  }
  blocks.close();
  const time = timeOfName(fileName);
  const { headings, targets, isOneStep } = blocks;
  return {
    name: stemOfName(fileName),
    ...(time !== undefined && { time }),
    blocks: blocks.done,
    ...(headings.length > 0 && { headings }),
    ...(targets.length > 0 && { targets }),
    ...(isOneStep && { isOneStep }),
  };
}

/** `walk@1.5.txt`, `walk@1.5`: 1.5. */
function timeOfName(fileName: string): number | undefined {
  const found = /@([-+]?(?:\d+(?:\.\d*)?|\.\d+)(?:e[-+]?\d+)?)(?:\.[a-z]\w*)?$/i.exec(fileName)?.[1];
  return found === undefined ? undefined : Number(found);
}

/** UTF-8; UTF-16 if it says so, as Windows' shell redirects it. */
function decodeText(bytes: Uint8Array): string {
  const encoding =
    bytes[0] === 0xff && bytes[1] === 0xfe ? 'utf-16le' : bytes[0] === 0xfe && bytes[1] === 0xff ? 'utf-16be' : 'utf-8';
  return new TextDecoder(encoding).decode(bytes);
}

function isBinary(bytes: Uint8Array): boolean {
  if (bytes[0] >= 0xfe) return false;
  const end = Math.min(bytes.length, 1024);
  for (let i = 0; i < end; i++) if (bytes[i] === 0) return true;
  return false;
}
