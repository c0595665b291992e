/**
 * How much a file of another program may become in memory: as much as its own size makes likely. Bytes may be used many
 * times over, by instances, accessors of the same view, curves of many nodes, or be packed a thousandfold, so that a
 * few hundred of them would else ask for gigabytes.
 */

/** Numbers of any file. */
const BASE = 4e6;
/** For each of its bytes: real files, packed ones too, need less than half. */
const PER_BYTE = 16;

/** Numbers that a take holds for each node and each morph target, moved or not. */
const PER_NODE_OF_TAKE = 30;

/** Most numbers that a file of that size may become. @param base of any file of its kind */
export function mostNumbers(bytes: number, base = BASE): number {
  return base + PER_BYTE * bytes;
}

/** The memory that one file may still ask for. */
export class Budget {
  private left: number;

  /**
   * @param bytes of the file and those beside it
   * @param fail says why the file can't be read, and throws
   * @param most numbers that it may become
   */
  constructor(
    readonly bytes: number,
    private readonly fail: (message: string) => never,
    private readonly most = mostNumbers(bytes),
  ) {
    this.left = most;
  }

  /** Counts a take: every take of a character has channels of all its joints and morphs. */
  spendTake(nodes: number, targets: number, what: string): void {
    this.spend(PER_NODE_OF_TAKE * (nodes + targets), what);
  }

  /** Counts numbers that are about to be made of the file's; fails if they are more than it may have. @param what for messages */
  spend(numbers: number, what: string): void {
    this.left -= numbers;
    if (this.left >= 0) return;
    this.fail(
      `${what} needs more than ${this.most} numbers in memory, the limit for a file of ${this.bytes} bytes. It may be damaged: export it again, with less data.`,
    );
  }
}
