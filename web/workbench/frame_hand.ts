// Frames placed by hand: dragged along the plane of ground's axes that is seen best, or moved by Alt and the arrow keys.

import { Plane, Raycaster, Vector2, Vector3, type Object3D, type PerspectiveCamera } from "three";

export interface FrameMark {
  body: string;
  name: string;
  /** Its place is that of the frame in its body. */
  mark: Object3D;
}

export interface PlacedFrame {
  body: string;
  name: string;
  /** In the body [m]; null: a coordinate that has not been moved. */
  position: [number | null, number | null, number | null];
}

export interface FrameHandHooks {
  space: HTMLElement;
  camera: PerspectiveCamera;
  /** Whether a drag turns the machine. */
  turning: (is: boolean) => void;
  mark: (x: number, y: number) => FrameMark | null;
  chosen: () => FrameMark | null;
  /** Of the machine [m]. */
  size: () => number;
  draw: () => void;
  moved: (frame: PlacedFrame) => void;
}

/** Smallest power of ten above a thousandth of the machine. */
const stepOf = (size: number) => 10 ** Math.ceil(Math.log10(1e-3 * size));

export class FrameHand {
  constructor(private readonly hooks: FrameHandHooks) {
    const { space } = hooks;
    let held: { frame: FrameMark; plane: Plane; offset: Vector3; first: Vector3 } | null = null;
    // Before the controls, which would turn the machine.
    space.addEventListener(
      "pointerdown",
      (event) => {
        const frame = event.button === 0 ? hooks.mark(event.clientX, event.clientY) : null;
        if (!frame) return;
        const at = frame.mark.getWorldPosition(new Vector3());
        const plane = new Plane().setFromNormalAndCoplanarPoint(this.normal(), at);
        const hit = this.under(event, plane);
        if (!hit) return;
        held = { frame, plane, offset: at.clone().sub(hit), first: frame.mark.position.clone() };
        hooks.turning(false);
      },
      true,
    );
    const follow = (event: PointerEvent): Vector3 | null => {
      const hit = held && this.under(event, held.plane);
      return held && hit ? held.frame.mark.parent!.worldToLocal(hit.add(held.offset)) : null;
    };
    const move = (event: PointerEvent) => {
      const place = held && follow(event);
      if (!held || !place) return;
      held.frame.mark.position.copy(place);
      hooks.draw();
    };
    const drop = (event: PointerEvent) => {
      if (!held) return;
      const { frame, first } = held;
      const place = follow(event) ?? first;
      held = null;
      hooks.turning(true);
      // A click is no drag.
      if (place.distanceTo(first) < 0.004 * hooks.size()) {
        frame.mark.position.copy(first);
        return hooks.draw();
      }
      this.tell(frame, first, place);
    };
    addEventListener("pointermove", move);
    addEventListener("pointerup", drop);
    space.addEventListener(
      "keydown",
      (event) => {
        const ways: Record<string, [number, number]> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
        const way = ways[event.key];
        const frame = event.altKey && way ? hooks.chosen() : null;
        if (!frame || !way) return;
        event.preventDefault();
        event.stopImmediatePropagation();
        const step = (event.shiftKey ? 10 : 1) * stepOf(hooks.size());
        const [right, up] = this.axes();
        const first = frame.mark.position.clone();
        const place = frame.mark.getWorldPosition(new Vector3()).addScaledVector(right, way[0] * step).addScaledVector(up, way[1] * step);
        this.tell(frame, first, frame.mark.parent!.worldToLocal(place));
      },
      true,
    );
  }

  private tell({ body, name, mark }: FrameMark, first: Vector3, place: Vector3): void {
    const step = stepOf(this.hooks.size());
    const round = (now: number, was: number) => (Math.abs(now - was) < 0.3 * step ? null : Math.round(now / step) * step);
    mark.position.copy(place);
    this.hooks.draw();
    this.hooks.moved({ body, name, position: [round(place.x, first.x), round(place.y, first.y), round(place.z, first.z)] });
  }

  /** The axis of ground that is nearest to the direction of sight. */
  private normal(): Vector3 {
    const sight = this.hooks.camera.getWorldDirection(new Vector3());
    const size = [Math.abs(sight.x), Math.abs(sight.y), Math.abs(sight.z)];
    return new Vector3().setComponent(size.indexOf(Math.max(...size)), 1);
  }

  /** The axes of ground that point most to the right and most upwards. */
  private axes(): [Vector3, Vector3] {
    const { camera } = this.hooks;
    const normal = this.normal();
    const nearest = (to: Vector3) => {
      const all = [new Vector3(1, 0, 0), new Vector3(0, 1, 0), new Vector3(0, 0, 1)].filter((axis) => Math.abs(axis.dot(normal)) < 0.5);
      const best = all.reduce((a, b) => (Math.abs(b.dot(to)) > Math.abs(a.dot(to)) ? b : a));
      return best.clone().multiplyScalar(Math.sign(best.dot(to)) || 1);
    };
    return [nearest(new Vector3(1, 0, 0).applyQuaternion(camera.quaternion)), nearest(new Vector3(0, 1, 0).applyQuaternion(camera.quaternion))];
  }

  private under(event: PointerEvent, plane: Plane): Vector3 | null {
    const box = this.hooks.space.getBoundingClientRect();
    const ray = new Raycaster();
    ray.setFromCamera(new Vector2((2 * (event.clientX - box.left)) / box.width - 1, 1 - (2 * (event.clientY - box.top)) / box.height), this.hooks.camera);
    return ray.ray.intersectPlane(plane, new Vector3());
  }
}
