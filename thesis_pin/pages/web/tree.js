"use strict";
// A robot without loops that its page moves by itself: forward kinematics of what
// thesis_pin/pages/live/alone.py lays down. Matrices are nine numbers, by rows.

function makeTree(tree, hooks) {
  const times = (a, b) => {
    const c = new Array(9);
    for (let i = 0; i < 3; i++) for (let j = 0; j < 3; j++) {
      c[3 * i + j] = a[3 * i] * b[j] + a[3 * i + 1] * b[3 + j] + a[3 * i + 2] * b[6 + j];
    }
    return c;
  };
  const act = (m, [x, y, z]) => [0, 3, 6].map((i) => m[i] * x + m[i + 1] * y + m[i + 2] * z);
  const add = (a, b) => a.map((value, i) => value + b[i]);
  const ONE = [1, 0, 0, 0, 1, 0, 0, 0, 1];

  function about([x, y, z], angle) {  // Rodrigues; the axis may have any length
    const size = Math.hypot(x, y, z);
    if (!size) return ONE;
    const s = Math.sin(angle * size), h = 2 * Math.sin(angle * size / 2) ** 2;
    [x, y, z] = [x / size, y / size, z / size];
    return [1 - h * (y * y + z * z), h * x * y - s * z, h * x * z + s * y,
      h * x * y + s * z, 1 - h * (x * x + z * z), h * y * z - s * x,
      h * x * z - s * y, h * y * z + s * x, 1 - h * (x * x + y * y)];
  }

  function matrix(quaternion) {
    const size = Math.hypot(...quaternion), [x, y, z, w] = quaternion.map((value) => value / size);
    return [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w),
      2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w),
      2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)];
  }

  // By the largest of four squares, so that nothing small is divided by.
  function quaternion(m) {
    const [a, b, c] = [m[0], m[4], m[8]];
    const squares = [1 + a - b - c, 1 - a + b - c, 1 - a - b + c, 1 + a + b + c];
    const rows = [[squares[0], m[1] + m[3], m[2] + m[6], m[7] - m[5]],
      [m[1] + m[3], squares[1], m[5] + m[7], m[2] - m[6]],
      [m[2] + m[6], m[5] + m[7], squares[2], m[3] - m[1]],
      [m[7] - m[5], m[2] - m[6], m[3] - m[1], squares[3]]];
    const row = rows[squares.indexOf(Math.max(...squares))], size = Math.hypot(...row);
    return row.map((value) => value / size);
  }

  // -- coordinates, as thesis_pin/loops/moving/coordinates.py counts them
  const LOCKED = 1e-9;
  function angles(q) {
    const m = matrix(q), sine = Math.min(1, Math.max(-1, -m[6])), level = Math.hypot(m[0], m[3]);
    if (level < LOCKED) return [0, Math.atan2(sine, level), Math.atan2(-m[1], m[4])];
    return [Math.atan2(m[7], m[8]), Math.atan2(sine, level), Math.atan2(m[3], m[0])];
  }
  const isRound = ({ kind }) => kind === "continuous" || kind === "heading";
  function value(one, q) {
    if (isRound(one)) return Math.atan2(q[one.q + 1], q[one.q]);
    return one.kind === "angle" ? angles(q.slice(one.q, one.q + 4))[one.part] : q[one.q];
  }

  function placed(one, q, where) {
    q = [...q];
    if (isRound(one)) {
      q.splice(one.q, 2, Math.cos(where), Math.sin(where));
    } else if (one.kind === "angle") {
      const turns = angles(q.slice(one.q, one.q + 4));
      turns[one.part] = where;
      const [roll, pitch, yaw] = turns.map((angle, k) => about(ONE.slice(3 * k, 3 * k + 3), angle));
      q.splice(one.q, 4, ...quaternion(times(yaw, times(pitch, roll))));
    } else {
      q[one.q] = where;
      follow(q, one.q, new Set([one.q]));
    }
    return q;
  }

  // Coupled joints go along, each by the one that ties it: factor q + factor q = constant.
  function follow(q, moved, known) {
    for (const [a, first, b, second, constant] of tree.couplings) {
      if (a === moved && !known.has(b)) {
        q[b] = (constant - first * q[a]) / second;
        follow(q, b, known.add(b));
      } else if (b === moved && !known.has(a)) {
        q[a] = (constant - second * q[b]) / first;
        follow(q, a, known.add(a));
      }
    }
  }

  // -- where everything is
  function within({ kind, q: k, screws }, q) {
    if (kind === "free") return [matrix(q.slice(k + 3, k + 7)), q.slice(k, k + 3)];
    if (kind === "ball") return [matrix(q.slice(k, k + 4)), [0, 0, 0]];
    if (kind === "planar") {
      return [about([0, 0, 1], Math.atan2(q[k + 3], q[k + 2])), [q[k], q[k + 1], 0]];
    }
    let turn = ONE, shift = [0, 0, 0];
    screws.forEach((screw, i) => {
      const way = kind === "round" ? Math.atan2(q[k + 1], q[k]) : q[k + i];
      shift = add(shift, act(turn, screw.slice(0, 3).map((part) => part * way)));
      turn = times(turn, about(screw.slice(3), way));
    });
    return [turn, shift];
  }

  function places(q) {
    const turns = [ONE], shifts = [[0, 0, 0]];
    for (const joint of tree.joints) {
      const [turn, shift] = within(joint, q), above = turns[joint.parent];
      turns.push(times(above, times(joint.turn, turn)));
      shifts.push(add(shifts[joint.parent], act(above, add(joint.shift, act(joint.turn, shift)))));
    }
    let mass = 0, sum = [0, 0, 0];
    tree.masses.forEach(([one, ...lever], k) => {
      mass += one;
      sum = add(sum, add(act(turns[k], lever), shifts[k]).map((part) => part * one));
    });
    turns.push(ONE);  // the centre of mass, as the item's joint -1
    shifts.push(sum.map((part) => part / mass));
    return { turns, shifts };
  }

  function samples(q, levels) {
    const { turns, shifts } = places(q);
    const point = (joint, at) => add(shifts.at(joint), act(turns.at(joint), at));
    const turned = turns.map(quaternion);
    return hooks.map(({ kind, joint, at, tip, marks, level }) => {
      if (kind === "ball") {
        const known = marks === null ? 0 : levels.get(marks);
        const position = known === undefined ? [null, null, null] : point(joint, at);
        return level ? { position, level: [known ?? 0] } : { position };
      }
      if (kind === "arrow") {
        const origin = point(joint, at), end = tip ? point(...tip) : origin;
        return { origin, vector: end.map((value, k) => value - origin[k]) };
      }
      return { placement: [...shifts.at(joint), ...turned.at(joint)] };
    });
  }

  // -- what there is to say
  const short = (number) => String(Number(number.toPrecision(3)));
  function limit(one, q) {
    const where = value(one, q), low = one.low ?? -Infinity, high = one.high ?? Infinity;
    const excess = Math.max(where - high, low - where, 0);
    if (excess > tree.limit) {
      const [scale, unit] = { rad: [180 / Math.PI, "°"], m: [1e3, " mm"] }[one.unit] || [1, ""];
      return [`${short(excess * scale)}${unit} beyond its limit`, 1];
    }
    if (Math.abs(where - low) <= tree.limit) return ["at its lower limit", 0];
    return Math.abs(where - high) <= tree.limit ? ["at its upper limit", 0] : ["", null];
  }

  const digits = (x) => (Number.isInteger(x) && Math.abs(x) < 1e15 ? x.toFixed(1) : String(x));
  function toml(q) {
    const lines = tree.pose.map(([key, begin, count, round]) => {
      const values = round ? [Math.atan2(q[begin + 1], q[begin])] : q.slice(begin, begin + count);
      const text = values.map(digits).join(", ");
      return `${key} = ${values.length === 1 ? text : `[${text}]`}`;
    });
    return ["format = 1", "[joints]", ...lines, ""].join("\n");
  }

  // Where the robot stands after a slider was moved, as the server would answer.
  function moved(stand, k, where) {
    const q = placed(tree.coordinates[k], stand.state, where), marks = [], levels = new Map();
    for (const one of tree.coordinates) {
      const [mark, level] = limit(one, q);
      marks.push(mark);
      if (level !== null) levels.set(one.joint, Math.max(level, levels.get(one.joint) ?? 0));
    }
    return {
      ...stand, state: q, marks, notes: [],
      values: tree.coordinates.map((one) => value(one, q)),
      readouts: stand.readouts.map(([label]) => [label, "–"]),
      items: samples(q, levels),
      toml: toml(q), q: `q = np.array([${q.map(digits).join(", ")}])`,
    };
  }
  return { moved };
}
