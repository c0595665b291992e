/** Discarding unkeyed changes: apart from `pose.ts`, since the page does it from its first frame on. */
import { command } from '../command.ts';
import { nullable, number } from '../schema/shape.ts';
import { countUnkeyed, documentWithoutUnkeyed } from '../unkeyed.ts';

/** Discards the unkeyed changes of all characters, so that keyed DOFs return to their keys. */
export const discardUnkeyed = command({
  id: 'pose.dropUnkeyed',
  args: {
    /** Transport time whose unkeyed changes are kept; null discards all. */
    exceptSeconds: nullable(number),
  },
  label(document, { exceptSeconds }) {
    const count = countUnkeyed(document, exceptSeconds);
    return `Discard ${count} unkeyed ${count === 1 ? 'change' : 'changes'}`;
  },
  run(document, { exceptSeconds }) {
    return documentWithoutUnkeyed(document, exceptSeconds);
  },
});
