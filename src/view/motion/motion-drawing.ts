/** Of the motion of a character: the path of the selected joint, and the poses before and after the current time. */
import { Group } from 'three';
import { steppedCharacter } from '../../evaluate/stepped-take.ts';
import type { Character } from '../../model/document.ts';
import type { Display, Selection } from '../../model/session.ts';
import type { ShownCharacter, ShownCharacters } from '../shown-characters.ts';
import type { StageTheme } from '../theme.ts';
import { Ghosts } from './ghosts.ts';
import { Trail } from './trail.ts';

export class MotionDrawing {
  readonly object = new Group();
  private readonly trail: Trail;
  private readonly ghosts = new Ghosts();

  /** @param redraw called when a path that takes longer is there */
  constructor(
    private readonly characters: Pick<ShownCharacters, 'seen' | 'visible'>,
    redraw: () => void,
  ) {
    this.trail = new Trail(redraw);
    this.object.add(this.trail.object, this.ghosts.object);
  }

  setTheme(theme: StageTheme): void {
    this.trail.setTheme(theme);
    this.ghosts.setTheme(theme);
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
    this.ghosts.fill(shown, display, timeSeconds, playedRange, framesPerSecond);
  }

  dispose(): void {
    this.trail.dispose();
    this.ghosts.dispose();
  }
}

/** The character as it plays. */
function played({ character }: ShownCharacter, { stepped }: Display): Character {
  return stepped ? steppedCharacter(character) : character;
}
