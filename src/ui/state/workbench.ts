/**
 * What every panel is given: the document's store, the viewport, and the page's own state beside them. `main.ts` builds
 * it; panels know nothing of files, workers or addresses, for those arrive as functions.
 */
import type { Playback } from '../../edit/playback.ts';
import type { Store } from '../../edit/store.ts';
import type { FormatKind } from '../../project/kinds.ts';
import type { UnsavedPart } from '../../project/save/saved-parts.ts';
import type { Viewport } from '../../view/viewport.ts';
import type { IconName } from '../kit/icons.ts';
import type { Observable } from '../kit/observable.ts';
import type { KeptOffer } from './kept-offer.ts';
import type { GroupName, MenuName } from './menus.ts';
import type { Messages } from './messages.ts';
import type { Posing } from './posing.ts';
import type { Settings } from './settings.ts';
import type { Bindable } from './shortcuts.ts';
import type { Timeline } from './timeline.ts';

/** What the page asks of the viewport, so that a test can stand in for it. */
export type WorkbenchStage = Pick<
  Viewport,
  | 'show'
  | 'seek'
  | 'pick'
  | 'frameAll'
  | 'frameSelection'
  | 'reveal'
  | 'keepClear'
  | 'lookFrom'
  | 'cameraView'
  | 'setTheme'
  | 'character'
  | 'hover'
  | 'takePointer'
  | 'requestRender'
  | 'addOverlay'
  | 'placementOf'
  | 'pickedCopy'
  | 'sizeOf'
  | 'holdTravel'
  | 'vertexAt'
  | 'turnView'
  | 'eye'
  | 'canvas'
  | 'stats'
>;

export interface Workbench {
  readonly store: Store;
  readonly actions: ActionList;
  readonly viewport: WorkbenchStage;
  /** The element that the viewport was built in; the page gives it its place. */
  readonly viewportElement: HTMLElement;
  readonly transport: Observable<Playback>;
  /** What the curve editor and the dope sheet show. */
  readonly timeline: Timeline;
  /** How the viewport takes the hand. */
  readonly posing: Posing;
  readonly settings: Observable<Settings>;
  readonly messages: Messages;
  /** A file on its way in. */
  readonly loading: Observable<Loading | undefined>;
  /** The one dialog that is open. */
  readonly dialog: Observable<DialogName | undefined>;
  readonly files: FileActions;
  /** Work that an earlier page left behind, offered. */
  readonly kept: Observable<KeptOffer | undefined>;
}

/**
 * A part of the workbench: a panel takes what it uses, and says so by its type.
 *
 *     function takesPanel(wb: Uses<'store' | 'timeline'>): HTMLElement
 */
export type Uses<Members extends keyof Workbench> = Pick<Workbench, Members>;

/** All that the page can do just now. Only `action.ts` looks inside: there actions are found, told of and run. */
export interface ActionList {
  /** In the order of the menus. */
  all(): readonly Action[];
  /** What the actions are about: they may use all of it, whoever runs them may not. */
  readonly page: Workbench;
}

/** One record behind a menu entry, a shortcut, a line of the `?` page and a scripted call. */
export interface Action extends Bindable {
  /** Stable: `play.toggle`. */
  readonly id: string;
  readonly label: string | ((wb: Workbench) => string);
  /** Where the label depends on something: what it is called apart from that. */
  readonly name?: string;
  /** A second line in the menu. */
  readonly detail?: string;
  readonly group: GroupName;
  /** `View`, or `View/Draw` for a menu within. Absent: only keys and search. */
  readonly menu?: MenuName | `${MenuName}/${string}`;
  /** A second menu that it stands in, for those who look for it there. */
  readonly alsoIn?: { readonly menu: MenuName; readonly section?: number };
  /** Entries of one menu with different sections have a line between them. */
  readonly section?: number;
  readonly icon?: IconName;
  /** A held key runs it again and again. */
  readonly repeats?: boolean;
  /** Always, where absent. */
  enabled?(wb: Workbench): boolean;
  /** Where it is not: the reason, in a sentence, in place of the detail. */
  whyNot?(wb: Workbench): string | undefined;
  /** Shows a tick; `radio` among alternatives. */
  checked?(wb: Workbench): boolean;
  readonly radio?: boolean;
  /** A promise where its script is fetched first. */
  run(wb: Workbench, args?: unknown): void | Promise<void>;
}

export type DialogName =
  | 'shortcuts'
  | 'search'
  | 'save'
  | 'about'
  | 'retarget'
  | 'holdPins'
  | 'skinWeights'
  | CurveToolName;
/** The curve tools that ask for something. */
export type CurveToolName = 'simplify' | 'resample' | 'bake' | 'scaleKeys' | SampleToolName;
/** Those for sampled motion that do. */
export type SampleToolName = 'convertToKeys' | 'smoothSamples' | 'resampleSamples';

export interface Loading {
  /** Name of the file being read. */
  readonly label: string;
  /** Bytes. */
  readonly done: number;
  /** 0 while it is not known. */
  readonly of: number;
  cancel(): void;
}

export interface SampleEntry {
  readonly id: string;
  readonly label: string;
  readonly description: string;
}

/** What the page can do with files. */
export interface FileActions {
  /** The browser's file dialog. */
  open(): void;
  openFolder(): void;
  openSample(id: string): void;
  /** Read whenever a menu opens, so the list may arrive late. */
  readonly samples: readonly SampleEntry[];
  drop(data: DataTransfer): void;
  paste(data: DataTransfer): void;
  /** What is not saved yet; characters in their order. */
  readonly unsaved: Pick<Observable<readonly UnsavedPart[]>, 'get' | 'subscribe'>;
  /** Saves that: in place, or where the person says. */
  saveChanged(): void;
  /** Reads a character's files again, where someone changed them beside the page. */
  reload(characterId: string): void;
  canReload(characterId: string): boolean;
  /**
   * Parts of one kind, to a place that the person chooses. A kind that the character does not have is made: skeleton and
   * animation of motion capture, and the other way round, at the transport's frame rate.
   */
  save(characterId: string, kind: FormatKind): void;
  /** A character as one zip. */
  saveAll(characterId: string): void;
}
