import type { Precision } from '../../dataset/float-pool.ts';
import type { TakeOptions } from '../../dataset/take.ts';
import type { GivenPath } from '../paths.ts';
import type { ExportFormat } from './formats.ts';
import type { MotionKind } from './motion-files.ts';
import type { KnownRate } from './switches.ts';
import type { TargetFiles } from './target.ts';

/** The same for all takes of an export. */
export interface ExportSettings extends TargetFiles, KnownRate, Omit<TakeOptions, 'target'> {
  /** The caller's, absolute. */
  readonly folder: string;
  /** Output folder, and one in it for files that are not finished; absolute. */
  readonly out: string;
  readonly scratch: string;
  /** Files of archives that inputs of the same archive may name. */
  readonly parts: readonly GivenPath[];
  /** Numbers, or files of motion. */
  readonly to: ExportFormat | MotionKind;
  /** Tolerance of keys made of samples; absent: the default. */
  readonly tolerance?: number;
  readonly precision: Precision;
  /** Whether existing outputs are overwritten. */
  readonly replaces: boolean;
  /** Whether takes are checked for flags. */
  readonly isChecked: boolean;
  /** Whether records say how long a take took. */
  readonly isTimed: boolean;
  /** Of the options and the version: two exports with the same give the same for an input. */
  readonly key: string;
}
