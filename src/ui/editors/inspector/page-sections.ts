/** Sections of the page rather than of a character: how it draws, and playback. */
import type { GUI } from 'lil-gui';
import { LOOP_MODES } from '../../../edit/playback.ts';
import { DEFAULT_DISPLAY, type Display } from '../../../model/session.ts';
import { ANGLES, TIME_DISPLAYS } from '../../state/settings.ts';
import type { Uses } from '../../state/workbench.ts';
import { Slider, type SliderOptions, showIn } from '../../widgets/numbers/slider.ts';
import { LOOP_LABELS } from '../transport/actions.ts';
import { setDisplay } from '../viewport/actions.ts';
import { addGhostRows } from './ghost-rows.ts';

/** How bones and onion skin are drawn. Whether they are is switched in the menu *Show*. */
export function displaySection(wb: Uses<'settings' | 'messages'>, section: GUI): void {
  const showThickness = addThickness(wb, section);
  const showGhosts = addGhostRows(wb, section);
  section.add({ reset: () => setDisplay(wb, DEFAULT_DISPLAY) }, 'reset').name('Reset display');
  wb.settings.subscribe((now, before) => {
    if (now.display === before.display) return;
    showGhosts(now.display);
    showThickness(now.display);
  });
}

/** How thick bones are drawn. */
function addThickness(wb: Uses<'settings' | 'messages'>, section: GUI): (display: Display) => void {
  const { display } = wb.settings.get();
  const refuse = (reason: string) => wb.messages.note(reason, 'warning');
  const options = { span: [0.25, 4], bounds: [0.25, 4], step: 0.05, decimals: 2 } as const;
  const row = new Slider(section, 'Bone thickness', display.boneThickness, options, refuse);
  row.onChange((boneThickness: number) => setDisplay(wb, { boneThickness }));
  return (now) => row.showValue(now.boneThickness);
}

export function playbackSection(wb: Uses<'transport' | 'settings' | 'messages'>, section: GUI): void {
  const { transport, settings } = wb;
  const refuse = (reason: string) => wb.messages.note(reason, 'warning');
  const rates: SliderOptions = { span: [-4, 4], bounds: [-4, 4], step: 0.05, decimals: 3, suffix: '×' };
  const rate = new Slider(section, 'Speed', transport.get().rate, rates, refuse);
  rate.onChange((value: number) => transport.update((p) => ({ ...p, rate: value })));
  const binding = {
    loop: transport.get().loop,
    angles: settings.get().angles,
    time: settings.get().timeDisplay,
  };
  const loops = Object.fromEntries(LOOP_MODES.map((mode) => [LOOP_LABELS[mode], mode]));
  const loop = section.add(binding, 'loop', loops).name('Loop');
  loop.onChange((mode: (typeof LOOP_MODES)[number]) => transport.update((p) => ({ ...p, loop: mode })));
  const frameRates: SliderOptions = { bounds: [1, 1000], step: 1, decimals: 3 };
  const fps = new Slider(section, 'Frames per second', transport.get().framesPerSecond, frameRates, refuse);
  fps.onChange((framesPerSecond: number) => {
    if (framesPerSecond >= 1) transport.update((p) => ({ ...p, framesPerSecond }));
  });
  const time = section.add(binding, 'time', [...TIME_DISPLAYS]).name('Time unit');
  time.onChange((timeDisplay: (typeof TIME_DISPLAYS)[number]) => settings.update((s) => ({ ...s, timeDisplay })));
  const angles = section.add(binding, 'angles', [...ANGLES]).name('Angle unit');
  angles.onChange((unit: (typeof ANGLES)[number]) => settings.update((s) => ({ ...s, angles: unit })));

  transport.subscribe((now, before) => {
    if (now.rate !== before.rate) rate.showValue(now.rate);
    if (now.framesPerSecond !== before.framesPerSecond) fps.showValue(now.framesPerSecond);
    showIn(loop, now.loop);
  });
  settings.subscribe((now) => {
    showIn(angles, now.angles);
    showIn(time, now.timeDisplay);
  });
}
