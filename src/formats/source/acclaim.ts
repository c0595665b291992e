/** `.asf`: the lines of each bone. `.amc`: the lines of each frame, and of each bone in it. */
import type { Located, Locator } from './locator.ts';
import { RowsBuilder } from './row-lines.ts';

/** Marks the lines of bones in `found`, which become joints in the order of the hierarchy. */
export function asfLocator(found: Located): Locator {
  return new AsfLocator(found);
}

/** Marks the frames of a motion, and the lines of bones in them, in `found`. */
export function amcLocator(found: Located): Locator {
  return new AmcLocator(found);
}

/** Frames with the same bones in the same lines are one block of rows. */
class AmcLocator implements Locator {
  readonly inRows = false;
  private rows = new RowsBuilder(1);
  /** Of the rows. */
  private bones: readonly string[] = [];
  private first = 0;
  /** Frames begun. */
  private frames = 0;
  private frameLine = 0;
  /** Those of this frame, on the lines after its first one. */
  private own: string[] = [];
  private last = 0;

  constructor(private readonly found: Located) {}

  word(text: string, line: number): void {
    if (line === this.last) return;
    this.last = line;
    if (this.frames === 0) return;
    const { own } = this;
    for (let next = this.frameLine + 1 + own.length; next < line; next++) own.push('');
    own.push(text);
  }

  value(line: number): void {
    if (line === this.last) return;
    if (this.frames > 0) this.endFrame();
    this.last = line;
    this.frames++;
    this.frameLine = line;
    this.own = [];
  }

  open(): void {}

  close(): void {}

  end(line: number): void {
    if (this.frames === 0) return;
    this.endFrame();
    this.endRows(line);
  }

  private endFrame(): void {
    const { own, bones, frames, frameLine } = this;
    const isSame = own.length === bones.length && own.every((name, i) => name === bones[i]);
    if (!isSame) {
      if (frames > 1) this.endRows(frameLine - 1);
      this.rows = new RowsBuilder(1);
      this.bones = own;
      this.first = frames - 1;
    }
    this.rows.token(frameLine, () => 1);
  }

  private endRows(line: number): void {
    const { rows, bones, first } = this;
    this.found.rows.push({ of: 'frame', lines: { ...rows.done(), end: line }, first, bones });
  }
}

interface BoneLines {
  readonly from: number;
  to: number;
}

class AsfLocator implements Locator {
  readonly inRows = false;
  private readonly bones = new Map<string, BoneLines>();
  private readonly children = new Map<string, string[]>();
  private section = '';
  private last = 0;
  private bone: BoneLines | undefined;
  /** The first word of the line. */
  private head = '';

  constructor(private readonly found: Located) {}

  word(text: string, line: number): void {
    const isFirst = line !== this.last;
    this.last = line;
    if (isFirst) this.head = text;
    if (isFirst && text.startsWith(':')) {
      this.section = text;
      this.bone = undefined;
    }
    const lines = this.bones.get('root');
    if (this.section === ':root') {
      if (lines) lines.to = line;
      else this.bones.set('root', { from: line, to: line });
    } else if (this.section === ':bonedata') this.inBones(text, line, isFirst);
    else if (this.section === ':hierarchy' && !isFirst) {
      const below = this.children.get(this.head) ?? [];
      below.push(text);
      this.children.set(this.head, below);
    }
  }

  private inBones(text: string, line: number, isFirst: boolean): void {
    if (isFirst && text === 'begin') this.bone = { from: line, to: line };
    if (this.bone) this.bone.to = line;
    if (this.bone && !isFirst && this.head === 'name' && !this.bones.has(text)) this.bones.set(text, this.bone);
    if (isFirst && text === 'end') this.bone = undefined;
  }

  value(line: number): void {
    this.last = line;
    if (this.bone) this.bone.to = line;
  }

  open(): void {}

  close(): void {}

  /** Joints are numbered depth first. */
  end(): void {
    const { found, bones, children } = this;
    const open = ['root'];
    const seen = new Set<string>();
    for (let name = open.pop(); name !== undefined; name = open.pop()) {
      const lines = bones.get(name);
      if (seen.has(name) || (!lines && name !== 'root')) continue;
      const joint = seen.size;
      seen.add(name);
      if (lines) found.marks.push({ target: { kind: 'joint', root: 0, joint }, from: lines.from, to: lines.to });
      open.push(...(children.get(name) ?? []).toReversed());
    }
  }
}
