"""Live clouds: the two nodes of the shape `classic` (welkin/density/hero.glsl) out of Blender's own nodes.

The noises are Blender's: Voronoi as the law's cellular noise, and where the law has four-dimensional simplex noise,
Perlin's, which varies as much (standard deviation .244 both). Shape and statistics agree with the law, the single
billows do not."""
import math

import bpy

from . import parameters

NOISE, MAIN, GRADIENT, MATERIAL = "Welkin Cloud Noise", "Welkin Cloud Main", "Welkin Shape Gradient", "Welkin live cloud"
CURVE_POINTS = 24
SIZES = 10.0  # cells of the texture in the cloud's size at an overall scale of 1
CHURN = 60.0  # s, in which the noise becomes another
MEAN_COSINE = 0.86  # of droplets
STEP_RATE = 0.1  # Cycles' own step is a tenth of the box
# Sockets that are parameters of [hero.classic], by node.
MAIN_PARAMETERS = ("cloud_scale", "density", "distortion")


def title(name):
    return name.replace("_", " ").title()


def rows(table):
    """Rows of the table `hero.form` or `hero.classic`."""
    return {row["name"]: row for row in parameters.ROOT.children["hero"].children[table].rows}


class _Build:
    """Adds nodes to a tree and links them; inputs are sockets, numbers or triples of numbers."""

    def __init__(self, tree):
        self.tree, self._columns, self._depth = tree, {}, {}

    def node(self, kind, **settings):
        made = self.tree.nodes.new(kind)
        for name, value in settings.items():
            setattr(made, name, value)
        return made

    def link(self, node, **inputs):
        """Fills inputs by name or, as i0, i1, by number, and puts the node right of what it depends on."""
        depth = 0
        for name, value in inputs.items():
            socket = node.inputs[int(name[1:])] if name[0] == "i" and name[1:].isdigit() else node.inputs[title(name)]
            if isinstance(value, bpy.types.NodeSocket):
                self.tree.links.new(value, socket)
                depth = max(depth, 1 + self._depth.get(value.node.name, 0))
            else:
                socket.default_value = value
        self._depth[node.name] = depth
        row = self._columns[depth] = self._columns.get(depth, 0) + 1
        node.location = 190 * depth, -190 * row
        return node

    def math(self, operation, *values, clamp=False):
        node = self.node("ShaderNodeMath", operation=operation, use_clamp=clamp)
        return self.link(node, **{f"i{i}": v for i, v in enumerate(values)}).outputs[0]

    def vector(self, operation, *values, scale=None):
        node = self.node("ShaderNodeVectorMath", operation=operation)
        inputs = {f"i{i}": v for i, v in enumerate(values)}
        if scale is not None:
            inputs["scale"] = scale
        return self.link(node, **inputs).outputs[0]

    def split(self, vector):
        return self.link(self.node("ShaderNodeSeparateXYZ"), i0=vector).outputs

    def mixed(self, value, share):
        """1 where the share is 0, twice the value where it is 1."""
        return self.math("MULTIPLY_ADD", self.math("MULTIPLY_ADD", value, 2.0, -1.0), share, 1.0)


def _socket(group, name, kind, value=None, limits=None, output=False):
    if hasattr(group, "interface"):  # Blender 4.0
        socket = group.interface.new_socket(name=name, in_out="OUTPUT" if output else "INPUT", socket_type=kind)
    else:
        socket = (group.outputs if output else group.inputs).new(kind, name)
    if value is not None:
        socket.default_value = value
    if limits:
        socket.min_value, socket.max_value = limits


def _parameter(group, row):
    kind = "NodeSocketVector" if row["kind"] == "vector" else "NodeSocketFloat"
    default = row["default"] if row["kind"] == "vector" else float(row["default"])
    _socket(group, title(row["name"]), kind, default, tuple(float(v) for v in row["range"]))


def _begin(name):
    group = bpy.data.node_groups.new(name, "ShaderNodeTree")
    build = _Build(group)
    return group, build


def noise_group():
    """The distortion texture, from 0 to 1, at a position in m."""
    found = bpy.data.node_groups.get(NOISE)
    if found:
        return found
    group, b = _begin(NOISE)
    _socket(group, "Position", "NodeSocketVector")
    _socket(group, "Place", "NodeSocketVector")
    _socket(group, "Generated", "NodeSocketVector")
    _socket(group, "Size", "NodeSocketFloat", 1000.0, (1.0, 1e6))
    for name, row in rows("classic").items():
        if name not in MAIN_PARAMETERS:
            _parameter(group, row)
    _socket(group, "Distortion Noise", "NodeSocketFloat", output=True)
    i = b.node("NodeGroupInput").outputs
    # In cells, without the share of the cloud's place that the texture follows, and against the wind.
    wind = b.vector("SCALE", b.vector("NORMALIZE", i["Wind Direction"]),
                    scale=b.math("MULTIPLY", i["Wind Strength"], i["Time"]))
    place = b.vector("SUBTRACT", b.vector("SUBTRACT", i["Position"], b.vector("SCALE", i["Place"], scale=i["Stationary"])),
                     wind)
    p = b.vector("SCALE", place, scale=b.math("DIVIDE", b.math("MULTIPLY", i["Overall Scale"], SIZES), i["Size"]))

    def cells(at):
        voronoi = b.node("ShaderNodeTexVoronoi", voronoi_dimensions="3D", feature="F1", distance="EUCLIDEAN")
        distance = b.link(voronoi, vector=at, scale=1.0, randomness=1.0).outputs["Distance"]
        smooth = b.node("ShaderNodeMapRange", interpolation_type="SMOOTHSTEP")
        return b.link(smooth, i0=distance, i1=0.0, i2=1.0, i3=1.0, i4=0.0).outputs[0]

    fine = cells(b.vector("MULTIPLY_ADD", p, (2.0, 2.0, 2.0), (17.3, 5.9, 11.7)))
    both = b.math("DIVIDE", b.math("MULTIPLY_ADD", i["Worley Clump"], fine, cells(p)),
                  b.math("ADD", 1.0, i["Worley Clump"]))

    def perlin(at, detail, roughness):
        texture = b.node("ShaderNodeTexNoise", noise_dimensions="4D")
        age = b.math("DIVIDE", i["Time"], CHURN)
        factor = b.link(texture, vector=at, w=age, scale=1.0, detail=detail, roughness=roughness,
                        distortion=0.0).outputs[0]
        return b.math("MULTIPLY_ADD", factor, 2.0, -1.0)

    q = b.vector("SCALE", p, scale=i["Noise Scale"])
    bent = b.math("MULTIPLY_ADD", perlin(b.vector("ADD", q, (31.1, 47.3, 8.3)), 0.0, 0.5), 0.5, 1.0)
    across = b.math("MULTIPLY_ADD", b.split(i["Generated"])[0], 36.0, -18.0)  # 18 x / half width
    waves = b.math("MULTIPLY_ADD", b.math("SINE", b.math("MULTIPLY", across, bent)), 0.5, 0.5)
    texture = b.math("MULTIPLY_ADD", b.math("SUBTRACT", waves, both), i["Wave"], both)

    # Blender's octaves are a weighted mean; the law's a sum whose weights begin with a half.
    gain = b.math("MINIMUM", i["Noise Whisp"], 0.999)
    weights = b.math("DIVIDE", b.math("SUBTRACT", 1.0, b.math("POWER", gain, i["Noise Detail"])),
                     b.math("SUBTRACT", 1.0, gain))
    octaves = perlin(q, b.math("SUBTRACT", i["Noise Detail"], 1.0), gain)
    fbm = b.math("MULTIPLY_ADD", octaves, b.math("MULTIPLY", weights, 0.5), 0.5, clamp=True)
    product = b.math("MULTIPLY", b.mixed(texture, i["Worley Influence"]), b.mixed(fbm, i["Noise Influence"]))
    b.link(b.node("NodeGroupOutput"), i0=b.math("MULTIPLY", product, 0.5, clamp=True))
    return group


def main_group():
    """003 eq. 3.4: how dense the cloud is at a place in its box; O is 1.5 less the distortion noise."""
    found = bpy.data.node_groups.get(MAIN)
    if found:
        return found
    group, b = _begin(MAIN)
    _socket(group, "Generated", "NodeSocketVector")
    _socket(group, "Shape Gradient", "NodeSocketFloat", 1.0, (-100.0, 1.0))
    _socket(group, "Distortion Noise", "NodeSocketFloat", 0.5, (0.0, 1.0))
    for name in MAIN_PARAMETERS:
        _parameter(group, rows("classic")[name])
    _socket(group, "Density", "NodeSocketFloat", output=True)
    i = b.node("NodeGroupInput").outputs
    centred = b.vector("MULTIPLY_ADD", i["Generated"], (2.0, 2.0, 0.0), (-1.0, -1.0, 0.0))
    t = b.vector("SCALE", centred, scale=i["Cloud Scale"])
    dot = b.link(b.node("ShaderNodeVectorMath", operation="DOT_PRODUCT"), i0=t, i1=t).outputs["Value"]
    shape = b.math("SUBTRACT", i["Shape Gradient"], dot)
    offset = b.math("SUBTRACT", i["Distortion Noise"], 0.5)
    d = b.math("MAXIMUM", b.math("MULTIPLY_ADD", offset, i["Distortion"], shape), 0.0)
    b.link(b.node("NodeGroupOutput"), i0=b.math("MULTIPLY", d, i["Density"]))
    return group


def gradation(radii, height):
    """Square of the radius at a share of the height: the cubic of welkin/density/hero_shape.cpp."""
    s = [r * r for r in radii]
    at = height * (len(s) - 1)
    k = min(int(at), len(s) - 2)

    def secant(j):
        return s[j + 1] - s[j]

    def slope(j):
        if j in (0, len(s) - 1):
            return secant(0 if j == 0 else len(s) - 2)
        a, b = secant(j - 1), secant(j)
        return 0.0 if a * b <= 0 else 2 * a * b / (a + b)

    t = at - k
    u = 1 - t
    value = (s[k] * (1 + 2 * t) * u * u + slope(k) * t * u * u + s[k + 1] * t * t * (3 - 2 * t)
             - slope(k + 1) * t * t * u)
    return max(value, 0.0)


def gradient_group(radii):
    """A group of its own for each cloud: S(Tz), a curve that the user may draw anew; beyond its ends it falls off."""
    group, b = _begin(GRADIENT)
    _socket(group, "Generated", "NodeSocketVector")
    _socket(group, "Cloud Scale", "NodeSocketFloat", 1.0, (0.01, 10.0))
    _socket(group, "Shape Gradient", "NodeSocketFloat", output=True)
    i = b.node("NodeGroupInput").outputs
    height = b.math("SUBTRACT", b.split(i["Generated"])[2], 0.5)
    h = b.math("MULTIPLY_ADD", height, i["Cloud Scale"], 0.5)
    within = b.math("ADD", h, 0.0, clamp=True)
    curve = b.node("ShaderNodeFloatCurve")
    points = curve.mapping.curves[0].points
    for k in range(CURVE_POINTS):
        x = k / (CURVE_POINTS - 1)
        y = gradation(radii, x)
        point = points[k] if k < 2 else points.new(x, y)
        point.location, point.handle_type = (x, y), "VECTOR"
    curve.mapping.update()
    squares = b.link(curve, i0=1.0, i1=within).outputs[0]
    beyond = b.math("ABSOLUTE", b.math("SUBTRACT", h, within))
    b.link(b.node("NodeGroupOutput"), i0=b.math("MULTIPLY_ADD", beyond, -4.0, squares))
    return group


def _box(name, x, y, z):
    mesh = bpy.data.meshes.new(name)
    corners = [(i * x, j * y, k * z) for k in (0.0, 1.0) for j in (-0.5, 0.5) for i in (-0.5, 0.5)]
    mesh.from_pydata(corners, [], [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)])
    return mesh


def density(tree, form, classic):
    """Adds both nodes and their coordinates to a tree; the socket of the cloud's density, 0 to about 1."""
    b = _Build(tree)
    generated = b.node("ShaderNodeTexCoord").outputs["Generated"]
    scale = b.node("ShaderNodeValue", label="Cloud Scale").outputs[0]
    scale.default_value = classic["cloud_scale"]
    noise = b.node("ShaderNodeGroup", node_tree=noise_group(), width=200)
    b.link(noise, position=b.node("ShaderNodeNewGeometry").outputs["Position"],
           place=b.node("ShaderNodeObjectInfo").outputs["Location"], generated=generated,
           size=(form["width"] * form["height"]) ** 0.5)
    main = b.node("ShaderNodeGroup", node_tree=main_group(), width=200)
    for name, value in classic.items():
        if name not in ("cloud_scale",):
            (main if name in MAIN_PARAMETERS else noise).inputs[title(name)].default_value = value
    radii = [*form["radii_low"], *form["radii_high"]]
    gradient = b.link(b.node("ShaderNodeGroup", node_tree=gradient_group(radii), width=200), generated=generated,
                      cloud_scale=scale)
    b.link(main, generated=generated, cloud_scale=scale, shape_gradient=gradient.outputs[0],
           distortion_noise=noise.outputs[0])
    return main.outputs[0]


def _values(table, group):
    return {name: (getattr(group, parameters.identifier(name)) if group else row["default"])
            for name, row in rows(table).items()}


def live_cloud(context):
    """A box with a live cloud: that of the active hero cloud of the sky, or of the defaults."""
    sky = context.scene.welkin.sky
    hero = sky.hero[min(sky.active_hero, len(sky.hero) - 1)] if len(sky.hero) else None
    form = _values("form", hero and hero.form)
    classic = _values("classic", hero and hero.classic)
    material = bpy.data.materials.new(MATERIAL)
    material.use_nodes = True
    if hasattr(material, "cycles"):
        material.cycles.volume_step_rate = STEP_RATE
    tree = material.node_tree
    tree.nodes.clear()
    dense = density(tree, form, classic)
    b = _Build(tree)
    extinction = b.math("MULTIPLY", dense, hero.extinction if hero else 0.2)
    tree.nodes[-1].label = "Extinction (1/m)"
    volume = b.node("ShaderNodeVolumePrincipled")
    volume.inputs["Color"].default_value = (1.0, 1.0, 1.0, 1.0)
    volume.inputs["Anisotropy"].default_value = MEAN_COSINE
    volume.inputs["Density Attribute"].default_value = ""
    b.link(volume, density=extinction)
    b.link(b.node("ShaderNodeOutputMaterial"), volume=volume.outputs[0])
    for k, name in enumerate(("ShaderNodeMath", "ShaderNodeVolumePrincipled", "ShaderNodeOutputMaterial")):
        for node in tree.nodes:
            if node.bl_idname == name:
                node.location = 900 + 220 * k, 0
    box = bpy.data.objects.new(MATERIAL, _box(MATERIAL, form["width"], form["width"] * form["breadth"], form["height"]))
    box.data.materials.append(material)
    if hero:
        box.location = hero.position
        box.scale = (hero.scale,) * 3
        box.rotation_euler.z = math.pi / 2 - math.radians(hero.heading)
    context.scene.collection.objects.link(box)
    return box
