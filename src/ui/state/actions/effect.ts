/** Whether an action had any visible effect. */
import type { Workbench } from '../workbench.ts';

/** Call before an action; the returned function tells whether anything has changed since, or a message was shown. */
export function watchEffect(wb: Workbench): () => boolean {
  const before = noticeable(wb);
  return () => noticeable(wb).some((now, i) => now !== before[i]);
}

function noticeable({
  store,
  transport,
  timeline,
  posing,
  settings,
  messages,
  dialog,
  loading,
  comparing,
  guide,
  manual,
}: Workbench): readonly unknown[] {
  return [
    store.document,
    store.selection,
    messages.count,
    messages.listAsked.get(),
    dialog.get(),
    transport.get(),
    loading.get(),
    timeline.tween.get(),
    comparing.get(),
    guide.get(),
    manual.get(),
    settings.get(),
    timeline.view.get(),
    timeline.cycleQuestion.get(),
    timeline.autoKey.get(),
    timeline.copied,
    timeline.outsideCycle.get(),
    timeline.scaling.get(),
    timeline.takeRenameAsked.get(),
    posing.mode.get(),
    posing.chosenDof.get(),
    posing.copied.get(),
    posing.mirrored.get(),
    posing.rigSkin.get(),
    posing.rig.adding.get(),
    posing.rig.children.get(),
    posing.rig.axes.get(),
    posing.rig.renameAsked.get(),
    posing.ik.selected.get(),
  ];
}
