/** Of the motion of a character: the path of the selected joint, and the poses before and after the current time. */
import { Group } from 'three';
import { steppedCharacter } from '../../evaluate/stepped-take.ts';
import type { Character } from '../../model/document.ts';
import type { Display, Selection } from '../../model/session.ts';
import type { ShownCharacter, ShownCharacters } from '../shown-characters.ts';
import type { DrawnSkins } from '../skin/drawn-skins.ts';
import type { StageTheme } from '../theme.ts';
import { GhostSkins } from './ghost-skins.ts';
import { Ghosts } from './ghosts.ts';
import { Trail } from './trail.ts';

export class MotionDrawing {
  readonly object = new Group();
  /** The path of the selected joint. */
  readonly trail: Trail;
  /** Ghosts of skins are left out then if they are dear. */
  isPlaying = false;
  private readonly ghosts = new Ghosts();
  private readonly skins: GhostSkins;

  /** @param redraw called when a path that takes longer is there @param skins where ghosts of skins are drawn */
  constructor(
    private readonly characters: Pick<ShownCharacters, 'seen' | 'visible'>,
    redraw: () => void,
    skins: DrawnSkins,
  ) {
    this.skins = new GhostSkins(skins);
    this.trail = new Trail(redraw);
    this.object.add(this.trail.object, this.ghosts.object);
  }

  setTheme(theme: StageTheme): void {
    this.trail.setTheme(theme);
    this.ghosts.setTheme(theme);
    this.skins.setTheme(theme);
  }

  /** After an edit, or with another range. @param playedRange seconds of the transport */
  show({ characterId, joint }: Selection, display: Display, playedRange: readonly [number, number]): void {
    const entry = this.characters.seen(characterId);
    this.trail.show(display.trail ? entry && played(entry, display) : undefined, joint, playedRange, display.inPlace);
  }

  /**
   * Every frame. Ghosts are of the selected character, or of the only one if none is selected.
   *
   * @param playedRange seconds of the transport
   * @param framesPerSecond of takes without frames of their own: for ghosts that are frames apart
   */
  fill(
    { characterId }: Selection,
    display: Display,
    timeSeconds: number,
    playedRange: readonly [number, number],
    framesPerSecond: number,
  ): void {
    const { characters } = this;
    const { visible } = characters;
    const entry: ShownCharacter | undefined =
      characters.seen(characterId) ?? (visible.length === 1 ? visible[0] : undefined);
    const shown = display.ghosts ? entry && played(entry, display) : undefined;
    const skin = display.ghostsOf === 'skin' ? entry?.view.sharedSkin : undefined;
    this.ghosts.fill(skin ? undefined : shown, display, timeSeconds, playedRange, framesPerSecond);
    this.skins.isPlaying = this.isPlaying;
    this.skins.fill(skin && shown, skin, display, timeSeconds, playedRange, framesPerSecond);
  }

  dispose(): void {
    this.trail.dispose();
    this.ghosts.dispose();
    this.skins.dispose();
  }
}

/** The character as it plays. */
function played({ character }: ShownCharacter, { stepped }: Display): Character {
  return stepped ? steppedCharacter(character) : character;
}
