// A shape of a body as the results give it.

import type { Vector3 } from "three";
import type { Numbers } from "./data";

export interface ShapeData {
  name: string;
  kind: string;
  point: (name: string) => Vector3;
  number: (name: string) => number;
  list: (name: string) => Numbers;
  /** Of a beam. */
  heldAtBothEnds: boolean;
}
