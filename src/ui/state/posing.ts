/**
 * How the viewport takes the hand, shared by its tools, the inspector and the keys. Beside the document: what is pinned
 * or locked is in there (`model/ik.ts`).
 */
import type { DofValue } from '../../model/dofs.ts';
import type { PoseByNames } from '../../model/pose-by-names.ts';
import { type Observable, observable } from '../kit/observable.ts';
import { IkHand } from './ik-hand.ts';
import { RigHand } from './rig-hand.ts';

/**
 * `fk`: joints turn one by one. `ik`: points are pinned and dragged, and the joints follow. `rig`: the skeleton itself is
 * changed.
 */
export const POSING_MODES = ['fk', 'ik', 'rig'] as const;
export type PosingMode = (typeof POSING_MODES)[number];

/** What the skin does when the skeleton is changed: it stays where it is, or follows as if posed. */
export const RIG_SKINS = ['stays', 'follows'] as const;
export type RigSkin = (typeof RIG_SKINS)[number];

/** The DOF that the bone turns when it is dragged. */
export interface ChosenDof {
  readonly characterId: string;
  /** Into the character's DOFs. */
  readonly dof: number;
  /** `rx`: on another joint the DOF of that name is meant. */
  readonly name: string;
}

/** What else of a character changes where one DOF is changed by hand, from the first change of it to the release. */
export interface BesideDof {
  /** The DOF at a value and all that goes with it, for `setDofs`. */
  at(value: number): readonly DofValue[];
  /** Whenever the document has what `at` gave last. */
  shown(): void;
}

/** A pose by names, so that it goes onto other characters too. */
export interface CopiedPose {
  readonly pose: PoseByNames;
  /** The name of the character that it was copied from. */
  readonly from: string;
}

export class Posing {
  readonly mode: Observable<PosingMode> = observable<PosingMode>('fk');
  /** What the mode's tool puts beside the switch of modes (`mode-bar.ts`); the tool takes it away when it leaves. */
  readonly controls: Observable<HTMLElement | undefined> = observable<HTMLElement | undefined>(undefined);
  /** Of FK; see `active-dof.ts`. */
  readonly chosenDof: Observable<ChosenDof | undefined> = observable<ChosenDof | undefined>(undefined);
  /** While pins hold: what they make of a change of that DOF; undefined where it is no matter of theirs. */
  beside: ((characterId: string, dof: number) => BesideDof | undefined) | undefined;
  readonly rigSkin: Observable<RigSkin> = observable<RigSkin>('stays');
  readonly ik = new IkHand();
  readonly rig = new RigHand();
  /** The pose that was copied on this page, until another is. */
  readonly copied: Observable<CopiedPose | undefined> = observable<CopiedPose | undefined>(undefined);
  /** Characters posed while another's take moves them, each with that other: what was said of them is said once. */
  readonly toldToFollow = new Set<string>();
}
