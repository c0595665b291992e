/**
 * `.skel`: the lines of each joint and of each DOF's limits and pose. A file that begins with a number has a row for
 * each joint: see `joint-rows.ts`.
 */
import { LIMIT_TOKENS, SKEL_TYPES } from '../skel/joint-types.ts';
import { JointLines } from './joint-lines.ts';
import { JointRows } from './joint-rows.ts';
import type { Located, Locator } from './locator.ts';

const TYPES = new Set(SKEL_TYPES.map(({ keyword }) => keyword));
const DOF_OF_TOKEN = new Map(Object.entries(LIMIT_TOKENS).map(([dof, token]) => [token, dof]));
const OTHER_TOKENS = new Set([
  ...['offset', 'boxmin', 'boxmax', 'length', 'couple'],
  ...SKEL_TYPES.flatMap(({ tokens }) => [...tokens.keys()]),
]);
/** Words that are values: an order, a mode, names of DOFs. */
const CHOICES = new Set<string>(
  SKEL_TYPES.flatMap(({ tokens }) => [...tokens.values()].flatMap((p) => ('choices' in p ? [...p.choices] : []))),
);
/** Words after `couple`: the DOF, and the one it follows. */
const COUPLE_WORDS = 2;

/** Marks the lines of joints, and of their limits and poses, in `found`. */
export function skelLocator(found: Located): Locator {
  return new SkelLocator(found);
}

class SkelLocator implements Locator {
  inRows = false;
  private readonly joints: JointLines;
  private isFirst = true;
  private readonly rows: JointRows;
  /** After a joint's type, up to its brace: its name may be any word. */
  private inHead = false;
  private headLine = 0;
  /** After `limit`: the name of the DOF is next. */
  private isLimit = false;
  /** Words to come that mean no token. */
  private freeWords = 0;
  /** The limits or pose being read. */
  private dof: string | undefined;
  private from = 0;
  private to = 0;
  /** Depth of braces that are not a joint's, and the line of an unknown word, whose rest is skipped. */
  private skipped = 0;
  private skippedLine = 0;

  constructor(private readonly found: Located) {
    this.joints = new JointLines(found);
    this.rows = new JointRows(found);
  }

  word(text: string, line: number): void {
    this.isFirst = false;
    if (this.skipped > 0 || line === this.skippedLine) return;
    if (this.inHead) return;
    if (this.freeWords > 0) {
      this.freeWords--;
      this.joints.own(line);
      return;
    }
    if (this.isLimit) {
      this.isLimit = false;
      this.dof = text;
      this.to = line;
      this.joints.own(line);
      return;
    }
    this.endDof();
    if (TYPES.has(text)) {
      this.inHead = true;
      this.headLine = line;
      return;
    }
    this.joints.own(line);
    this.isLimit = text === 'limit';
    this.dof = text === 'pose' ? '' : DOF_OF_TOKEN.get(text);
    this.from = this.to = line;
    if (text === 'couple') this.freeWords = COUPLE_WORDS;
    const isKnown = this.isLimit || this.dof !== undefined || OTHER_TOKENS.has(text) || CHOICES.has(text);
    // As readers do: the rest of an unknown word's line is skipped, with the block that it opens.
    if (!isKnown) this.skippedLine = line;
  }

  value(line: number, read: () => number): void {
    if (this.isFirst) {
      this.isFirst = false;
      this.inRows = true;
    }
    if (this.inRows) {
      this.rows.token(line, read);
      return;
    }
    if (this.skipped > 0 || line === this.skippedLine || this.inHead) return;
    this.to = line;
    this.joints.own(line);
  }

  open(line: number): void {
    if (this.inHead) {
      this.inHead = false;
      this.joints.open(this.headLine);
      this.joints.own(line);
    } else this.skipped++;
  }

  close(line: number): void {
    if (this.skipped > 0) {
      this.skipped--;
      return;
    }
    this.endDof();
    this.skippedLine = 0;
    this.joints.close(line);
  }

  end(): void {
    if (this.inRows) this.rows.end();
  }

  private endDof(): void {
    const { dof, from, to } = this;
    const joint = this.joints.current;
    this.dof = undefined;
    this.isLimit = false;
    if (dof === undefined || !joint) return;
    const target = { kind: 'joint', root: joint.root, joint: joint.joint } as const;
    if (dof === '') this.found.marks.push({ target, from, to, isPose: true });
    else this.found.marks.push({ target: { ...target, dof }, from, to });
  }
}
