#pragma once

namespace hersey::model {

/// What stands before the tables of the reference page; its example is read by a test.
inline constexpr const char* reference_introduction = R"md(# Model file

This page is made by `hersey schema --markdown` from the description that the program itself checks models with. A
[JSON Schema](schema/model.schema.json) from the same source completes and checks models in an editor: put
`# yaml-language-server: $schema=...` with its place into the first line.

A model is a YAML file. It is read strictly: an unknown key, a missing one, a wrong unit, a value out of range, a name
that does not exist are each reported with line and column, what was found, what is allowed and the nearest valid name,
all together. `hersey check MODEL` does only that.

```yaml
hersey: 1
title: A journal under a constant load
parameters:
  load: 500 N
bodies:
  shaft: {mass: 1 kg, inertia: {xx: 1e-3 kg.m^2, yy: 1e-3 kg.m^2, zz: 1e-3 kg.m^2}}
joints:
  bench: {type: planar, between: [ground, shaft], axis: z}
drives:
  motor: {joint: bench, coordinate: rotation, speed: 3000 rpm}
forces:
  push: {type: force, body: shaft, components: [0 N, "-${load}", 0 N]}
lubricants:
  oil: {viscosity: 15 mPa.s}
bearings:
  main:
    shell: ground
    journal: shaft
    diameter: 50 mm
    width: 25 mm
    radial_clearance: 50 um
    lubricant: oil
    supply: {line: widest_gap, pressure: 1 bar}
simulation:
  duration: 0.2 s
  step: 0.2 ms
```

**Quantities** carry their unit: `45 mm`, `3570 rpm`, `15 mPa.s`, `1.28e-10 1/Pa`. Numbers without a dimension stand
bare, and so may any `0`. Three numbers share a unit, `0 48 0 mm`, or stand in a list with one each,
`[0 mm, 48 mm, 0]`. An angular velocity is given in `rpm`, `deg/s` or `rad/s`; `Hz` and `1/s` are refused there, because
they leave open whether turns or radians are meant. Everything is converted to SI when the file is read.

**Names** are letters, digits and `_`, beginning with a letter. A frame is `body` (the body's own) or `body.frame`.

**Parameters** stand at the top and are used as `${name}` anywhere below. Inside braces and brackets they must be
quoted. `--set load=800N` replaces a parameter for one run, and `--set bearings.main.grid.axial=25` any other value by its
key path.

Where a quantity, a whole number or an expression is expected, a parameter stands in parentheses: `+ - * / ^`, signs and
`pi` around it mean what they mean in arithmetic, and units are worked out with the numbers. With `a: -3`, `${a}^2` is 9,
`-${a}` is 3 and `2-${a}*1` is 5; `${a} mm` is -3 mm. A parameter may be derived from those above it:

```yaml
parameters:
  diameter: 50 mm
  relative_clearance: 1e-3
  clearance: "${relative_clearance}*${diameter}/2"     # 25 um
  pressure: 2 MPa
  load: "${pressure}*${diameter}*20 mm"                # 2000 N
  amplitude: "${load}/1 N"                             # 2000, a bare number: for {expression: "${amplitude}*t", unit: N}
```

Quantities are added where they measure the same. A bare number stands in an expression, a quantity only after it has been
divided by its unit. The radian counts: an angular velocity times a radius becomes a velocity by `/1 rad`. Degrees Celsius
are no factors and no summands; kelvins are. In a row, `0 -${load} 2*${load}`, a formula has no spaces. Text (titles, names of
files, words) takes a parameter as it is written.

## Templates

What repeats is written once, under `templates`, and put in by `use`:

```yaml
templates:
  main_bearing:
    parameters: {frame, angle: 90 deg}      # `frame` has no default: each use gives it
    shell: ground.${frame}
    journal: crank.${frame}
    diameter: 50 mm
    width: 20 mm
    radial_clearance: 30 um
    lubricant: oil
    supply: {line: "${angle}", pressure: 3 bar}
bearings:
  left: {use: {template: main_bearing, frame: main_left}}
  right: {use: {template: main_bearing, frame: main_right, angle: 75 deg}, width: 24 mm}
```

`use` stands in any mapping below, and at the top of the file, where a template may bring keys of several sections (a cylinder: its
rod, piston, joints and bearings). It is a name, `{template: name, parameter: value, ...}` or a list of these. A template's
parameters are numbers, quantities or words; a default may be derived from those above it and from the model's. They are used as
`${name}` in its values and in its keys, `rod_${n}`, and go before the model's of that name. Templates may use others.

Keys beside `use` go before the template's. A mapping that both have is merged so, key by key; anything else is replaced; a key
with nothing behind it removes the template's. Two templates of one list may not give the same key. A fault in a template is reported
with its own line and that of the use. `--set` and studies change parameters, templates
(`--set templates.main_bearing.width=18mm`), arguments (`--set bearings.left.use.angle=60deg`) and what came of them
(`--set bearings.left.width=18mm`). `hersey check --expanded` prints the model with everything put in.

YAML's own anchors and merge keys work too: `<<: *anchor` adds the keys of an earlier mapping that the own one does not have.
What templates, aliases and merge keys repeat is limited to 100000 values and 16 MB.
)md";

/// What stands before the tables of functions.
inline constexpr const char* reference_functions =
    R"md(Loads and drives are functions of time, loads also of joint coordinates and their rates. A function is one of

- a constant: `500 N`
- an expression: `{expression: "100*sin(2*pi*50*t)", unit: N}`
- a table: `{table: {file: gas.csv, x: angle, y: pressure}, over: main.rotation, period: 720 deg, scale: 4418 mm^2}`

A table that does not cover the run is reported before it starts, where its argument is the time or a joint that is
driven at a constant speed.
)md";

}  // namespace hersey::model
