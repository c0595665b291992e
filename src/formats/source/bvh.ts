/** `.bvh`: the lines of each joint, and the row of each frame. */
import { JointLines } from './joint-lines.ts';
import type { Located, Locator } from './locator.ts';
import { RowsBuilder } from './row-lines.ts';

/** Marks the lines of joints, and of the frames, in `found`. */
export function bvhLocator(found: Located): Locator {
  return new BvhLocator(found);
}

class BvhLocator implements Locator {
  inRows = false;
  private readonly joints: JointLines;
  /** After ROOT, JOINT or End, up to the brace: a name of any words. */
  private head: 'joint' | 'end' | undefined;
  private headLine = 0;
  private inEndSite = false;
  /** After CHANNELS. */
  private isCount = false;
  private width = 0;
  private inMotion = false;
  /** Number of `Frames:` and `Frame Time:` that have been read. */
  private labels = 0;
  private rows: RowsBuilder | undefined;

  constructor(private readonly found: Located) {
    this.joints = new JointLines(found);
  }

  word(text: string, line: number): void {
    if (this.head) return;
    if (this.inMotion) {
      // Labels with their numbers glued to them.
      if (/:[-+.]?\d/.test(text)) this.label();
      return;
    }
    this.joints.own(line);
    if (text === 'root' || text === 'joint') this.begin('joint', line);
    else if (text === 'end') this.begin('end', line);
    else if (text === 'channels') this.isCount = !this.inEndSite;
    else if (text === 'motion') this.inMotion = true;
  }

  value(line: number, read: () => number): void {
    if (this.rows) this.rows.token(line, read);
    else if (this.inMotion) this.label();
    else if (!this.head) {
      if (this.isCount) this.width += read();
      this.isCount = false;
      this.joints.own(line);
    }
  }

  open(line: number): void {
    if (this.head === 'joint') this.joints.open(this.headLine);
    else if (this.head === 'end') this.inEndSite = true;
    this.head = undefined;
    this.joints.own(line);
  }

  close(line: number): void {
    if (this.inEndSite) {
      this.inEndSite = false;
      this.joints.own(line);
    } else this.joints.close(line);
  }

  end(): void {
    if (this.rows) this.found.rows.push({ of: 'frame', lines: this.rows.done() });
  }

  private begin(head: 'joint' | 'end', line: number): void {
    this.head = head;
    this.headLine = line;
  }

  private label(): void {
    this.labels++;
    if (this.labels < 2 || !(this.width > 0)) return;
    this.rows = new RowsBuilder(this.width);
    this.inRows = true;
  }
}
