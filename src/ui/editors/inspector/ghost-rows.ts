/** Rows of the onion skin: number of ghosts before and after, and their spacing. */
import type { GUI } from 'lil-gui';
import { type Display, GHOST_SHAPES, GHOST_UNITS, type GhostUnit, MAX_GHOSTS } from '../../../model/session.ts';
import type { Uses } from '../../state/workbench.ts';
import { Slider, showIn } from '../../widgets/numbers/slider.ts';
import { setDisplay } from '../viewport/actions.ts';

/** Default step in each unit, set when the unit changes; at keys there is none. */
const USUAL_STEP: Readonly<Record<GhostUnit, Partial<Display>>> = {
  frames: { ghostStep: 5 },
  seconds: { ghostStep: 0.2 },
  keys: {},
};

/** Adds the rows to a section. Returns a function that updates them from the settings. */
export function addGhostRows(wb: Uses<'settings' | 'messages'>, section: GUI): (display: Display) => void {
  const { display } = wb.settings.get();
  const refuse = (reason: string) => wb.messages.note(reason, 'warning');
  const counts = { span: [0, 10], bounds: [0, MAX_GHOSTS], step: 1, decimals: 0 } as const;
  const before = new Slider(section, 'Ghosts before', display.ghostsBefore, counts, refuse);
  const after = new Slider(section, 'Ghosts after', display.ghostsAfter, counts, refuse);
  before.onChange((count: number) => setDisplay(wb, { ghostsBefore: Math.round(count) }));
  after.onChange((count: number) => setDisplay(wb, { ghostsAfter: Math.round(count) }));
  const step = new Slider(
    section,
    'Ghost step',
    display.ghostStep,
    { bounds: [0.001, 1000], step: 0.01, decimals: 3 },
    refuse,
  );
  step.onChange((ghostStep: number) => {
    if (ghostStep > 0) setDisplay(wb, { ghostStep });
  });
  const binding = { unit: display.ghostStepIn };
  const unit = section.add(binding, 'unit', [...GHOST_UNITS]).name('Ghost step unit');
  unit.onChange((ghostStepIn: GhostUnit) => setDisplay(wb, { ghostStepIn, ...USUAL_STEP[ghostStepIn] }));
  const shape = section.add({ of: display.ghostsOf }, 'of', [...GHOST_SHAPES]).name('Ghosts of');
  shape.onChange((ghostsOf: Display['ghostsOf']) => setDisplay(wb, { ghostsOf }));
  return (now) => {
    before.showValue(now.ghostsBefore);
    after.showValue(now.ghostsAfter);
    step.showValue(now.ghostStep);
    step.disable(now.ghostStepIn === 'keys');
    showIn(unit, now.ghostStepIn);
    showIn(shape, now.ghostsOf);
  };
}
