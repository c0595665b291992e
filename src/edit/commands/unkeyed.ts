/** Discarding unkeyed changes: apart from `pose.ts`, since the page does it from its first frame on. */
import { finiteNumber } from '../arguments.ts';
import type { Command } from '../store.ts';
import { countUnkeyed, documentWithoutUnkeyed } from '../unkeyed.ts';

export interface DropUnkeyed {
  /** Transport time whose unkeyed changes are kept; null discards all. */
  readonly exceptSeconds: number | null;
}

/** Discards the unkeyed changes of all characters, so that keyed DOFs return to their keys. */
export const discardUnkeyed: Command<DropUnkeyed> = {
  id: 'pose.dropUnkeyed',
  label(document, { exceptSeconds }) {
    const count = countUnkeyed(document, exceptSeconds);
    return `Discard ${count} unkeyed ${count === 1 ? 'change' : 'changes'}`;
  },
  run(document, { exceptSeconds }) {
    if (exceptSeconds !== null) finiteNumber(exceptSeconds, '"exceptSeconds"');
    return documentWithoutUnkeyed(document, exceptSeconds);
  },
};
