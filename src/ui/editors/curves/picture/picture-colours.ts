/** The stylesheet's colours for canvases. */
import { readTimeColours, type TimeColours, translucent } from '../../timeline/time-ground.ts';
import { BASE_COLOURS, type BaseColour } from '../scene/colours.ts';

export interface PictureColours {
  readonly time: TimeColours;
  /** `#rrggbb`: lines are mixed from these. */
  readonly palette: Readonly<Record<BaseColour, string>>;
  /** Background of everything, and outline of text over curves. */
  readonly plot: string;
  readonly label: string;
  readonly valueLine: string;
  readonly fineValueLine: string;
  readonly zeroLine: string;
  readonly hatch: string;
  readonly key: string;
  readonly selected: string;
  readonly boxFill: string;
  readonly boxLine: string;
  readonly hover: string;
  /** Another program's values, and those that are wrong. */
  readonly theirs: string;
  readonly wrong: string;
}

export function readPictureColours(target: Element): PictureColours {
  const style = getComputedStyle(target);
  const colour = (name: string) => style.getPropertyValue(name).trim();
  const time = readTimeColours(target);
  return {
    time,
    palette: {
      x: colour(BASE_COLOURS.x),
      y: colour(BASE_COLOURS.y),
      z: colour(BASE_COLOURS.z),
      moveX: colour(BASE_COLOURS.moveX),
      moveY: colour(BASE_COLOURS.moveY),
      moveZ: colour(BASE_COLOURS.moveZ),
      accent: colour(BASE_COLOURS.accent),
      text: colour(BASE_COLOURS.text),
      faint: colour(BASE_COLOURS.faint),
    },
    plot: colour('--plot'),
    label: colour('--text-faint'),
    valueLine: colour('--plot-line'),
    fineValueLine: time.fineLine,
    zeroLine: colour('--plot-zero'),
    hatch: colour('--hatch'),
    key: colour('--key'),
    selected: colour('--selected'),
    boxFill: translucent(colour('--accent'), 0.12),
    boxLine: colour('--accent'),
    hover: colour('--text'),
    theirs: colour('--text'),
    wrong: colour('--error'),
  };
}
