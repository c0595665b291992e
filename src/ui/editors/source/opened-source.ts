/** A file that is shown: its text, its lines as far as they are known, and what is on them. */
import type { LineIndex, SourceMap } from '../../../model/source-map.ts';
import type { SourceFiles } from '../../state/source.ts';
import { LineText, type ShownLine } from './line-text.ts';

/** What is shown before the lines are counted. */
const FIRST_BYTES = 65536;

/** How far reading is. */
export type SourceState =
  | { readonly kind: 'reading'; readonly share: number }
  | { readonly kind: 'read' }
  | { readonly kind: 'failed'; readonly message: string };

export class OpenedSource {
  /** Map of the whole file; undefined until it is read. */
  map: SourceMap | undefined;
  state: SourceState = { kind: 'reading', share: 0 };
  text: Blob | undefined;
  /** What it is read from. */
  private readonly given: Blob | undefined;
  private lines: LineText | undefined;
  private readonly abort = new AbortController();

  /**
   * @param onLines called when there are more lines
   * @param onText called when the text of some has come
   * @param onState called when reading continues, ends or fails
   */
  constructor(
    readonly path: string,
    private readonly files: SourceFiles,
    private readonly calls: { onLines(): void; onText(): void; onState(): void },
  ) {
    this.given = files.given(path);
  }

  /** Whether the file was opened again since. */
  get isOld(): boolean {
    return this.files.given(this.path) !== this.given;
  }

  /** Resolves when the file is read, or can't be. */
  async read(): Promise<void> {
    const { signal } = this.abort;
    try {
      let first: Promise<void> | undefined;
      const map = await this.files.read(
        this.path,
        signal,
        (text) => {
          this.text = text;
          first = this.showFirst(text);
          // It is told when the whole is read, or not at all if that fails too.
          first.catch(() => undefined);
        },
        (share) => this.set({ kind: 'reading', share }),
      );
      await first;
      if (signal.aborted || !this.text) return;
      this.map = map;
      this.lines = this.linesOf(this.text, map.index);
      this.set({ kind: 'read' });
      this.calls.onLines();
    } catch (error) {
      if (!signal.aborted) this.fail(error);
    }
  }

  get count(): number {
    return this.lines?.index.count ?? 0;
  }

  line(line: number): ShownLine | undefined {
    return this.lines?.get(line);
  }

  close(): void {
    this.abort.abort();
  }

  /** The lines at the start, at once. */
  private async showFirst(text: Blob): Promise<void> {
    const bytes = new Uint8Array(await text.slice(0, FIRST_BYTES).arrayBuffer());
    if (bytes.includes(0)) throw new Error('It is not text.');
    if (this.abort.signal.aborted || this.map) return;
    const shown = new TextDecoder().decode(bytes).split(/\r*\n|\r/).length;
    const index = { lines: Float64Array.of(1), offsets: Float64Array.of(0), count: shown, bytes: bytes.length };
    this.lines = this.linesOf(text, index);
    this.calls.onLines();
  }

  private linesOf(text: Blob, index: LineIndex): LineText {
    return new LineText(
      text,
      index,
      () => this.calls.onText(),
      (error) => this.fail(error),
    );
  }

  private fail(error: unknown): void {
    // A blob of a file that has changed on disk can't be read.
    const hasChanged = error instanceof DOMException;
    const message = error instanceof Error && !hasChanged ? error.message : 'It has changed on disk. Open it again.';
    this.set({ kind: 'failed', message });
  }

  private set(state: SourceState): void {
    this.state = state;
    this.calls.onState();
  }
}
