/** Takes the camera along with the selected joint: to it when it is chosen, and as it moves from then on. */
import { Vector3 } from 'three';
import type { Selection } from '../model/session.ts';
import type { CameraRig } from './camera.ts';
import type { SkeletonDrawing } from './skeleton-drawing.ts';

export class JointFollower {
  private characterId: string | undefined;
  private joint = -1;
  private readonly last = new Vector3();
  private readonly step = new Vector3();
  private readonly point = new Vector3();

  /** Every frame in which something moved. */
  follow(isOn: boolean, { characterId, joint }: Selection, skeletons: SkeletonDrawing, rig: CameraRig): void {
    const { point } = this;
    const found =
      isOn && characterId !== undefined && joint !== undefined && skeletons.positionOf(characterId, 0, joint, point);
    if (!found) {
      this.characterId = undefined;
      return;
    }
    if (this.characterId === characterId && this.joint === joint) rig.shift(this.step.subVectors(point, this.last));
    else rig.moveTo(point);
    this.characterId = characterId;
    this.joint = joint;
    this.last.copy(point);
  }
}
