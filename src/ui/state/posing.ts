/**
 * State of posing in the viewport, shared by its tools, the inspector and shortcuts. Not part of the document: pins and
 * locks are (`model/ik.ts`).
 */
import type { Change } from '../../edit/change.ts';
import type { Command } from '../../edit/command.ts';
import type { SetDofs } from '../../edit/commands/pose.ts';
import type { Character, Document } from '../../model/document.ts';
import type { PoseByNames } from '../../model/pose-by-names.ts';
import type { DofValue } from '../../model/skeleton/dofs.ts';
import { type Observable, observable } from '../widgets/observable.ts';
import { IkHand } from './ik-hand.ts';
import { RigHand } from './rig-hand.ts';

/**
 * `select`: clicks only select. `pose`: hands, feet and heads are dragged, and their limbs follow. `fk`: joints are
 * rotated one by one. `ik`: points are pinned and dragged, and joints follow. `rig`: the skeleton itself is edited.
 */
export const POSING_MODES = ['select', 'pose', 'fk', 'ik', 'rig'] as const;
export type PosingMode = (typeof POSING_MODES)[number];

/** What the skin does when the skeleton is edited: it stays in place, or follows as if posed. */
export const RIG_SKINS = ['follows', 'stays'] as const;
export type RigSkin = (typeof RIG_SKINS)[number];

/** The DOF that dragging the bone changes. */
export interface ChosenDof {
  readonly characterId: string;
  /** Into the character's DOFs. */
  readonly dof: number;
  /** `rx`: on another joint the DOF of that name is active. */
  readonly name: string;
}

/** One of a character's DOFs. */
export interface LitDof {
  readonly characterId: string;
  /** Into the character's DOFs. */
  readonly dof: number;
}

/** Other changes of a character that go with editing DOFs of a joint, from the first change to the release. */
export interface BesideDofs {
  /** The DOFs at their values with all that changes with them, for `setDofs`. */
  at(values: readonly DofValue[]): readonly DofValue[];
  /** Call when the document has the last result of `at`. */
  shown(): void;
  /** Call at the end of a drag: what is drawn as held meanwhile is no longer. */
  over(): void;
}

/** A pose by joint names, so that it can be pasted on other characters. */
export interface CopiedPose {
  readonly pose: PoseByNames;
  /** Name of the character it was copied from. */
  readonly from: string;
}

/** `pose.setDofs`, or what does the same and more. */
export type PosingCommand = Command<SetDofs, Document | Change>;

export class Posing {
  readonly mode: Observable<PosingMode> = observable<PosingMode>('pose');
  /** The mode that the select tool leads back to. */
  private before: Exclude<PosingMode, 'select'> = 'pose';
  /** Controls of the mode's tool beside the mode switch (`mode-bar.ts`); the tool removes them when it leaves. */
  readonly controls: Observable<HTMLElement | undefined> = observable<HTMLElement | undefined>(undefined);
  /** For FK; see `active-dof.ts`. */
  readonly chosenDof: Observable<ChosenDof | undefined> = observable<ChosenDof | undefined>(undefined);
  /** A DOF that is pointed at elsewhere than in its row, which lights up. */
  readonly litDof: Observable<LitDof | undefined> = observable<LitDof | undefined>(undefined);
  /**
   * While pins hold: how they adapt to a change of DOFs of one joint; undefined if they aren't affected.
   *
   * @param joint the one whose handle is dragged: if it carries the body, feet that stand hold too
   */
  beside: ((characterId: string, dofs: readonly number[], joint?: number) => BesideDofs | undefined) | undefined;
  /** Characters as they came in, by id: what differs from it was set by hand. */
  readonly opened = new Map<string, Character>();
  /** While live mirror is on: what sets DOFs by hand, and those of their partners. */
  readonly mirrored: Observable<PosingCommand | undefined> = observable<PosingCommand | undefined>(undefined);
  readonly rigSkin: Observable<RigSkin> = observable<RigSkin>('stays');
  readonly ik = new IkHand();
  readonly rig = new RigHand();
  /** Index of the focused pose in the library of the current character. */
  readonly libraryPose: Observable<number> = observable(0);
  /** The last pose copied on this page. */
  readonly copied: Observable<CopiedPose | undefined> = observable<CopiedPose | undefined>(undefined);
  /** Retargeted characters that were posed, each with its source: the message is shown once. */
  readonly toldToFollow = new Set<string>();

  constructor() {
    this.mode.subscribe((_now, before) => {
      if (before !== 'select') this.before = before;
    });
  }

  get modeBeforeSelect(): Exclude<PosingMode, 'select'> {
    return this.before;
  }
}
