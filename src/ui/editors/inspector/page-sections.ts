/** Sections of the page rather than of a character: display and playback. */
import type { GUI } from 'lil-gui';
import { LOOP_MODES } from '../../../edit/playback.ts';
import { DEFAULT_DISPLAY, type Display } from '../../../model/session.ts';
import { ANGLES, TIME_DISPLAYS } from '../../state/settings.ts';
import type { Uses } from '../../state/workbench.ts';
import { Slider, type SliderOptions, showIn } from '../../widgets/numbers/slider.ts';
import { LOOP_LABELS } from '../transport/actions.ts';
import { BOX_STYLES, isSkinVisible, NO_SKIN, SKIN_STYLES, setDisplay } from '../viewport/actions.ts';
import { addGhostRows } from './ghost-rows.ts';

type Switch = { [K in keyof Display]: Display[K] extends boolean ? K : never }[keyof Display];

const SWITCHES: readonly (readonly [Switch, string])[] = [
  ['bones', 'Bones'],
  ['axes', 'Joint axes'],
  ['names', 'Joint names'],
  ['characterNames', 'Character names'],
  ['normals', 'Normals'],
  ['trail', 'Motion path'],
  ['ghosts', 'Onion skin'],
  ['grid', 'Grid'],
  ['shadow', 'Shadow'],
  ['orthographic', 'Orthographic'],
  ['follow', 'Follow joint'],
  ['inPlace', 'In place'],
];

export function displaySection(wb: Uses<'store' | 'settings' | 'messages'>, section: GUI): void {
  const binding = { ...wb.settings.get().display };
  const option = <K extends 'skin' | 'boxes'>(
    key: K,
    label: string,
    styles: readonly (readonly [Display[K], string])[],
  ) =>
    section
      .add(binding, key, Object.fromEntries(styles.map(([value, name]) => [name, value])))
      .name(label)
      .onChange((value: Display[K]) => setDisplay(wb, { [key]: value }));
  const skin = option('skin', 'Skin', SKIN_STYLES);
  const showSkin = () => {
    const hasSkin = isSkinVisible(wb);
    skin.enable(hasSkin);
    setTooltip(skin.domElement, hasSkin ? '' : NO_SKIN);
  };
  wb.store.subscribe((now, before) => {
    if (now.document.characters !== before.document.characters) showSkin();
  });
  showSkin();
  option('boxes', 'Boxes', BOX_STYLES);
  let showThickness: ((display: Display) => void) | undefined;
  let showGhosts: ((display: Display) => void) | undefined;
  for (const [key, label] of SWITCHES) {
    section
      .add(binding, key)
      .name(label)
      .onChange((value: boolean) => setDisplay(wb, { [key]: value }));
    if (key === 'bones') showThickness = addThickness(wb, section);
    if (key === 'ghosts') showGhosts = addGhostRows(wb, section);
  }
  section.add({ reset: () => setDisplay(wb, DEFAULT_DISPLAY) }, 'reset').name('Reset to default');
  wb.settings.subscribe((now, before) => {
    if (now.display === before.display) return;
    Object.assign(binding, now.display);
    for (const controller of section.controllers) controller.updateDisplay();
    showGhosts?.(now.display);
    showThickness?.(now.display);
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

import { setTooltip } from '../../widgets/tooltip.ts';
