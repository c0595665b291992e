/** Writes a character for another program, with progress. Loaded on first use. */
import { provideRetargeting } from '../evaluate/retarget/driving.ts';
import { writeExchange } from '../export/exchange.ts';
import type { ExchangeInput, ExchangeOutput, Progress } from './protocol.ts';
import { fromMessage } from './settled-takes.ts';

/** Between two messages of progress, in milliseconds. */
const INTERVAL = 100;

export async function exchangeFileOf(
  { format, character, options }: ExchangeInput,
  onProgress: (progress: Progress) => void,
): Promise<ExchangeOutput> {
  provideRetargeting();
  let last = performance.now();
  const { pieces, report } = await writeExchange(
    format,
    fromMessage(character),
    options,
    true,
    ({ label, fraction }) => {
      const now = performance.now();
      if (now - last < INTERVAL) return;
      last = now;
      onProgress({ label, done: fraction, of: 1 });
    },
  );
  const bytes = new Uint8Array(report.bytes);
  let at = 0;
  for (const piece of pieces) {
    bytes.set(piece, at);
    at += piece.length;
  }
  return { bytes, report };
}
