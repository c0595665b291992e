/**
 * `.bvh`, motion capture.
 *
 *     bvh = HIERARCHY { root } MOTION "Frames:" n "Frame Time:" seconds { row }
 *
 * Several roots are several characters, whose channels follow each other in each row. Keywords are read in any case. If
 * the hierarchy has errors, the number of values per row is unknown, so rows are not read.
 */
import type { Capture } from '../../model/files.ts';
import { type GrammarPart, stemOfName } from '../grammar.ts';
import { grammarReader, type Reader, type ReadResult, readWhole } from '../reader.ts';
import type { Tokens } from '../tokens.ts';
import { capturesOf } from './captures.ts';
import { hierarchy } from './hierarchy.ts';
import { motion } from './motion.ts';

/**
 * A reader for a `.bvh`: a character for each root.
 * @param byteLength the file's size, if known, to allocate the samples at once
 */
export function bvhReader(fileName: string, byteLength?: number): Reader<readonly Capture[]> {
  return grammarReader(fileName, (t) => captures(t, byteLength));
}

/** Reads a whole `.bvh`. */
export function readBvh(bytes: Uint8Array | string, fileName: string): ReadResult<readonly Capture[]> {
  // An estimate for text: numbers take one byte per character.
  return readWhole(bvhReader(fileName, bytes.length), bytes);
}

function* captures(t: Tokens, byteLength: number | undefined): GrammarPart<readonly Capture[] | undefined> {
  const roots = yield* hierarchy(t);
  if (t.report.hasErrors) return undefined;
  let width = 0;
  for (const { joints } of roots) for (const joint of joints) width += joint.pose.length;
  const samples = yield* motion(t, width, byteLength);
  return capturesOf(stemOfName(t.fileName), roots, samples);
}
