/** Writes a character as GLB, with progress. Loaded on first use. */
import { writeGlb } from '../export/glb/write.ts';
import type { GlbInput, GlbOutput, Progress } from './protocol.ts';
import { fromMessage } from './settled-takes.ts';

/** Between two messages of progress, in milliseconds. */
const INTERVAL = 100;

export function glbOf({ character, options }: GlbInput, onProgress: (progress: Progress) => void): GlbOutput {
  let last = performance.now();
  const { pieces, report } = writeGlb(fromMessage(character), options, true, ({ label, fraction }) => {
    const now = performance.now();
    if (now - last < INTERVAL) return;
    last = now;
    onProgress({ label, done: fraction, of: 1 });
  });
  const bytes = new Uint8Array(report.bytes);
  let at = 0;
  for (const piece of pieces) {
    bytes.set(piece, at);
    at += piece.length;
  }
  return { bytes, report };
}
