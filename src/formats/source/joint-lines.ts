/** The lines of nested joints that are each one's own: without those of its children, which split them. */
import type { Located } from './locator.ts';

interface OpenJoint {
  readonly root: number;
  readonly joint: number;
  /** Its lines so far that are not marked yet; 0: none. */
  from: number;
  to: number;
}

/** Marks the lines of nested joints while a file is scanned; several roots are counted from 0. */
export class JointLines {
  private readonly stack: OpenJoint[] = [];
  private root = -1;
  private count = 0;

  constructor(private readonly found: Located) {}

  /** Number of open joints. */
  get depth(): number {
    return this.stack.length;
  }

  /** The innermost open joint. */
  get current(): { readonly root: number; readonly joint: number } | undefined {
    return this.stack.at(-1);
  }

  /** A joint begins; without an open one it is a root. */
  open(line: number): void {
    const parent = this.stack.at(-1);
    if (parent) this.mark(parent);
    else {
      this.root++;
      this.count = 0;
    }
    this.stack.push({ root: this.root, joint: this.count++, from: line, to: line });
  }

  /** Something of the innermost joint is on a line. */
  own(line: number): void {
    const joint = this.stack.at(-1);
    if (!joint) return;
    if (joint.from === 0) joint.from = line;
    joint.to = line;
  }

  /** The innermost joint ends on this line. */
  close(line: number): void {
    this.own(line);
    const joint = this.stack.pop();
    if (joint) this.mark(joint);
  }

  private mark(joint: OpenJoint): void {
    const { root, from, to } = joint;
    if (from > 0) this.found.marks.push({ target: { kind: 'joint', root, joint: joint.joint }, from, to });
    joint.from = 0;
  }
}
