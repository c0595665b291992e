/** The text of single lines of a file, decoded only near those that are asked for. */
import { type LineIndex, lastUpTo } from '../../../model/source-map.ts';

/** Words that open a block or name a value, apart from numbers: they are coloured. */
export const WORDS = /(?<=^|[\s{}])[A-Za-z_][^\s{}]*/g;

/** Longer lines are cut, in characters: a frame of a large capture has some thousand. */
export const MAX_SHOWN = 2000;
/** Bytes read at an entry of the index: all its lines begin within the first half. */
const CHUNK_BYTES = 131072;
const KEPT_CHUNKS = 24;

export interface ShownLine {
  readonly text: string;
  /** Characters left out at its end; 0: none. */
  readonly more: number;
  /** `more` is a count of bytes: the line wasn't read to its end. */
  readonly isAbout: boolean;
}

/** Where the bytes are: a `Blob` or a part of one. */
export type Bytes = Pick<Blob, 'slice'>;

export class LineText {
  /** By entry of the index, the last used one last. Undefined while it is read. */
  private readonly chunks = new Map<number, readonly ShownLine[] | undefined>();

  /**
   * @param onRead called when lines that were asked for have come
   * @param onFail called if the file can't be read any more
   */
  constructor(
    private readonly bytes: Bytes,
    readonly index: LineIndex,
    private readonly onRead: () => void,
    private readonly onFail: (error: unknown) => void,
  ) {}

  /** A line, from 1; undefined if it has to be read first. */
  get(line: number): ShownLine | undefined {
    const entry = lastUpTo(this.index.lines, line);
    const known = this.chunks.get(entry);
    if (!this.chunks.has(entry)) void this.read(entry);
    else if (known) {
      this.chunks.delete(entry);
      this.chunks.set(entry, known);
    }
    return known?.[line - this.index.lines[entry]];
  }

  /** Reads a line, so that `get` has it. */
  async load(line: number): Promise<void> {
    const entry = lastUpTo(this.index.lines, line);
    if (!this.chunks.has(entry)) await this.read(entry);
  }

  private async read(entry: number): Promise<void> {
    const { index, chunks } = this;
    chunks.set(entry, undefined);
    const from = index.offsets[entry];
    const isLast = entry + 1 >= index.offsets.length;
    const end = isLast ? index.bytes : index.offsets[entry + 1];
    const stop = Math.min(end, from + CHUNK_BYTES);
    try {
      const bytes = await this.bytes.slice(from, stop).arrayBuffer();
      const count = (isLast ? index.count + 1 : index.lines[entry + 1]) - index.lines[entry];
      chunks.set(entry, linesOf(new TextDecoder().decode(bytes), count, end - stop));
    } catch (error) {
      this.onFail(error);
      return;
    }
    for (const old of chunks.keys()) {
      if (chunks.size <= KEPT_CHUNKS) break;
      chunks.delete(old);
    }
    this.onRead();
  }
}

/** @param unread bytes of the last line that aren't in the text */
function linesOf(text: string, count: number, unread: number): readonly ShownLine[] {
  const lines = text.split(/\r*\n|\r/).slice(0, count);
  return lines.map((line, i) => {
    const isAbout = unread > 0 && i === lines.length - 1;
    const more = Math.max(0, line.length - MAX_SHOWN) + (isAbout ? unread : 0);
    return { text: line.length > MAX_SHOWN ? line.slice(0, MAX_SHOWN) : line, more, isAbout };
  });
}
