/** `.anim`: the lines of each channel, and the row of each key. */
import type { Located, Locator } from './locator.ts';
import { RowsBuilder } from './row-lines.ts';

/** `time value tan_in tan_out` */
const KEY_WIDTH = 4;
const BLOCKS: ReadonlySet<string> = new Set(['animation', 'channel', 'keys']);

/** Marks the lines of channels, and of their keys, in `found`. */
export function animLocator(found: Located): Locator {
  return new AnimLocator(found);
}

class AnimLocator implements Locator {
  inRows = false;
  private head = '';
  private headLine = 0;
  /** The words of the open blocks. */
  private readonly blocks: string[] = [];
  private channel = -1;
  private channelLine = 0;
  private rows = new RowsBuilder(KEY_WIDTH);
  private times: number[] = [];

  constructor(private readonly found: Located) {}

  word(text: string, line: number): void {
    // Between the keyword of a block and its brace there may be names.
    if (BLOCKS.has(this.head) && line === this.headLine) return;
    this.head = text;
    this.headLine = line;
  }

  value(line: number, read: () => number): void {
    if (this.inRows && this.rows.token(line, read)) this.times.push(read());
  }

  open(): void {
    const { head } = this;
    this.blocks.push(head);
    this.head = '';
    if (head === 'channel' && this.blocks.length === 2) {
      this.channel++;
      this.channelLine = this.headLine;
    } else if (head === 'keys' && this.blocks.length === 3) {
      this.inRows = true;
      this.rows = new RowsBuilder(KEY_WIDTH);
      this.times = [];
    }
  }

  close(line: number): void {
    this.blocks.pop();
    const { channel, found, times } = this;
    if (this.inRows) {
      this.inRows = false;
      const indices = orderOf(times);
      found.rows.push({ of: 'key', channel, lines: this.rows.done(), ...(indices && { indices }) });
    } else if (this.blocks.length === 1 && channel >= 0) {
      found.marks.push({ target: { kind: 'channel', channel }, from: this.channelLine, to: line });
    }
  }

  end(): void {}
}

/** The index of each row's key, since keys are sorted by time; undefined if they are sorted in the file. */
function orderOf(times: readonly number[]): Uint32Array | undefined {
  if (times.every((time, i) => i === 0 || time >= times[i - 1])) return undefined;
  const order = times.map((_, row) => row).sort((a, b) => times[a] - times[b]);
  const keys = new Uint32Array(times.length);
  order.forEach((row, key) => {
    keys[row] = key;
  });
  return keys;
}
