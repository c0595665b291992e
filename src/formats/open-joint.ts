import { DEFAULT_BOX, type Joint } from '../model/skeleton/skeleton.ts';

/** In place of a joint that is not closed: filled from the last to the first, an array takes six times as much. */
export const OPEN_JOINT: Joint = {
  ...{ name: '', parent: -1, offset: [0, 0, 0], box: DEFAULT_BOX },
  ...{ motion: { kind: 'fixed' }, limits: [], pose: [] },
};
