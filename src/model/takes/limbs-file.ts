/** What a `.limbs.json` says: the limbs of a skeleton, the goals of a take, or both where they are called alike. */
import type { LimbByName } from '../limbs.ts';
import type { OtherFields } from '../other-fields.ts';
import type { FlattenedFile } from './layers-file.ts';
import type { Goal } from './take.ts';

/** The end of what files of limbs and goals are called: `walk.limbs.json`. */
export const LIMBS_EXTENSION = 'limbs.json';

/** The content of a `.limbs.json`. */
export interface LimbsFile {
  /** Absent of the file of a take. */
  readonly limbs?: readonly LimbByName[];
  /** Absent of the file of a skeleton. */
  readonly goals?: readonly Goal[];
  /** The file beneath the goals; absent only without goals. */
  readonly base?: string;
  readonly flattened?: FlattenedFile;
  readonly others?: OtherFields;
}
