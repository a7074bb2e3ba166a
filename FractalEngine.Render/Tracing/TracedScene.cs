using System.Collections.Concurrent;
using System.Collections.Immutable;
using FractalEngine.Core.DeepZoom;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Core.Rays;
using FractalEngine.Core.SceneQueries;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Visibility.Levels;
using FractalEngine.Render.Lights;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Views;

namespace FractalEngine.Render.Tracing;

/// <summary>The objects of a scene with all that light needs to know of their surfaces. Immutable: any number of threads may ask.</summary>
internal sealed record TracedScene
{
    // Rays leave a surface by this part of the scene's size: far more than rounding, far less than a pixel.
    private const double SurfaceOffset = 1e-9;

    // Roughness and metal change by less from one to the next than can be seen.
    private const int GradientGlossSteps = 256;

    private readonly TracedScene _whole;
    private readonly ConcurrentDictionary<Model, DeepZoomRayCaster> _zoomCasters;
    private readonly double _offset;
    private readonly ImmutableArray<PlacedModel> _objects;
    private readonly TracedModel[][] _models;
    private readonly Dictionary<Model, TracedModel> _surfaces;
    private readonly RenderSettings _settings;
    private readonly Vector[][] _colours;
    private readonly Vector[] _gradientEnds;
    private readonly InstanceGradient?[] _gradients;

    // By places in the gradient; empty where it is matt.
    private readonly Gloss?[][] _gradientGloss;

    // What multiplies the colours of an object's materials.
    private readonly Vector[] _tints;
    private readonly Lazy<TracedAreaLights?>? _areaLights;

    // What a view has of its own.
    private RayCaster _caster;
    private DeepZoom? _zoom;
    private SectionPlane? _section;

    /// <summary>Prepares a scene: its surfaces, and its objects for rays.</summary>
    /// <param name="scene">With its models loaded.</param>
    /// <param name="settings">The crease angle.</param>
    public TracedScene(LoadedScene scene, RenderSettings settings)
        : this(scene, settings, new(scene), [], [])
    {
    }

    private TracedScene(
        LoadedScene scene, RenderSettings settings, SceneRayCaster caster, Dictionary<Model, TracedModel> knownSurfaces,
        IEnumerable<KeyValuePair<Model, DeepZoomRayCaster>> zoomCasters)
    {
        _whole = this;
        _settings = settings;
        _zoomCasters = new(zoomCasters);
        _caster = caster;
        _objects = scene.Objects;
        var notices = ImmutableArray.CreateBuilder<string>();
        var textures = new TextureCache(notices, shareTextures: true, []);
        _surfaces = scene.Models.SelectMany(static model => model.Parts).ToDictionary(
            static model => model,
            model => knownSurfaces.GetValueOrDefault(model) ?? new TracedModel(model, settings.CreaseAngle, textures));
        _models = [.. _objects.Select(placed => placed.Model.Parts.Select(part => _surfaces[part]).ToArray())];
        _colours = [.. _objects.Select(static (placed, index) => placed.Parts.Select(
            (part, mesh) => ObjectPalette.ColourOf(part, index + mesh).ToLinearVector()).ToArray())];
        _gradientEnds = [.. _objects.Select((placed, index) =>
            placed.Gradient is { } gradient ? gradient.EndColour.ToLinearVector() : _colours[index][0])];
        _gradients = [.. _objects.Select(static placed => placed.Model is FractalModel model
            ? InstanceGradient.CreateOrNull(placed.Gradient, model) : null)];
        _gradientGloss = [.. _gradients.Select(static shading => shading is { Gradient: { IsGlossy: true } gradient }
            ? Enumerable.Range(0, GradientGlossSteps + 1)
                .Select(step => GradedSurface.At(gradient, (double)step / GradientGlossSteps)).ToArray()
            : [])];
        _tints = [.. _objects.Select(static placed => (placed.Declaration.Colour ?? Colour.White).ToLinearVector())];
        IsSeeThrough = _models.Any(static parts => parts.Any(static model => model.IsSeeThrough));
        _areaLights = _models.Any(static parts => parts.Any(static model => model.IsEmissive))
            ? new(() => TracedAreaLights.CreateOrNull(scene, _surfaces, Sampling == AreaLightSampling.Uniform))
            : null;
        Lamps = TracedLamps.CreateOrNull(scene);
        Notices = notices.ToImmutable();
        _offset = SurfaceOffset * scene.Bounds.FiniteDiagonalOr(1);
    }

    /// <summary>Sentences for the user about textures that can't be decoded, each when its model is prepared.</summary>
    public ImmutableArray<string> Notices { get; }

    /// <summary>True where light may pass through any surface.</summary>
    public bool IsSeeThrough { get; }

    /// <summary>
    /// The emissive faces, which are sampled; null where there are none, and in a deep zoom. There light of theirs is found by chance.
    /// </summary>
    public TracedAreaLights? AreaLights => _zoom is null && Sampling != AreaLightSampling.None ? _areaLights?.Value : null;

    /// <summary>The lights that have a surface, in the space of the view; null where there are none.</summary>
    public TracedLamps? Lamps { get; private init; }

    /// <summary>How the light of emissive faces is found; set before the first sample.</summary>
    public AreaLightSampling Sampling { get; set; }

    /// <summary>How far from a surface rays start that leave it, in the unit of the view.</summary>
    /// <param name="position">A point of the surface; in a deep zoom about the camera, since there is no size but its distance.</param>
    public double OffsetAt(Vector position) => _zoom is null ? _offset : SurfaceOffset * position.Length();

    /// <summary>The same surfaces for a view; those of a deep zoom are around the camera, in the unit of the zoom.</summary>
    /// <param name="zoom">Deep zoom of the view; null for none.</param>
    /// <param name="section">Plane that cuts the scene open, in the frame of the rays; null for none.</param>
    /// <param name="eye">Origin of that frame in world space, where there is a deep zoom.</param>
    public TracedScene ForView(DeepZoom? zoom, SectionPlane? section, Vector eye) => zoom is null && section is null ? _whole : _whole with
    {
        _zoom = zoom,
        _section = section,
        Lamps = zoom is null ? _whole.Lamps : _whole.Lamps?.RelativeTo(eye, Math.Exp(zoom.LogUnit)),
        _caster = zoom is null ? _whole._caster : _zoomCasters.GetOrAdd(
            _objects[zoom.ObjectIndex].Model,
            static model => new DeepZoomRayCaster(((FractalModel)model).Fractal, [])).WithRoots(zoom.Roots),
    };

    /// <summary>Prepares another scene, or another state of this one. What was prepared of models that both show is shared.</summary>
    /// <param name="scene">With its models loaded.</param>
    public TracedScene WithScene(LoadedScene scene)
    {
        var models = scene.Models.ToHashSet();
        return new(
            scene, _settings, ((SceneRayCaster)_whole._caster).WithScene(scene), _surfaces,
            _zoomCasters.Where(known => models.Contains(known.Key)));
    }

    /// <summary>Finds the nearest surface along a ray: a face, the section through a solid, or a lamp.</summary>
    public bool TryIntersect(
        in Ray ray, RayFootprint footprint, double minDistance, double maxDistance, QueryContext context, out TracedSurface surface)
    {
        var isFound = TryIntersectObjects(in ray, footprint, minDistance, maxDistance, context, out surface);
        if (Lamps is null)
        {
            return isFound;
        }

        var distance = isFound ? (surface.Position - ray.Origin).Length() : maxDistance;
        if (Lamps.FindNearest(in ray, minDistance, ref distance) is { } lamp)
        {
            var (place, back) = (ray.Origin + (distance * ray.Direction), -ray.Direction);
            surface = new(place, back, back, Vector.Zero, null, lamp.Emitter.SurfaceRadiance, 1) { Lamp = lamp };
            return true;
        }

        return isFound;
    }

    private bool TryIntersectObjects(
        in Ray ray, RayFootprint footprint, double minDistance, double maxDistance, QueryContext context, out TracedSurface surface)
    {
        surface = default;
        var start = minDistance;
        if ((_section is { } section && !section.TryClip(in ray, ref start, ref maxDistance))
            || !_caster.TryFindNearest(ray, context, out var hit, start, maxDistance, footprint))
        {
            return false;
        }

        var index = context.ObjectIndex;
        surface = CreateSurface(ray.Direction, in hit, index, context);
        // Behind a section the path to the face may be lost.
        if (start > minDistance)
        {
            surface = surface with { FaceIndex = -1 };
        }

        if (start > minDistance && _section is { HasCap: true, Normal: var normal }
            && IsWithinSolid(in ray, in hit, index, footprint, context))
        {
            surface = surface with { Position = ray.Origin + (start * ray.Direction), FaceNormal = normal, Normal = normal };
        }

        return true;
    }

    /// <summary>Number of maps that lead to the instance that a ray has hit last; 0 for a mesh.</summary>
    public int LevelOf(QueryContext context) =>
        context.InstancePath.Length + (_zoom is { } zoom ? zoom.Roots[context.ObjectIndex].ColourPath.MapCount : 0);

    /// <summary>Tells whether a ray comes to its first face from within a solid.</summary>
    private bool IsWithinSolid(in Ray ray, in RayHit hit, int index, RayFootprint footprint, QueryContext context)
    {
        if (IsInnerSide(in hit, index))
        {
            return true;
        }

        // Where solids touch, as the instances of a fractal do, the face of the next one may be found before that of the solid around.
        // From the other side, the latter is then found first, and seen from outside.
        var offset = OffsetAt(hit.Point);
        var back = new Ray(hit.Point + (offset * ray.Direction), -ray.Direction);
        return ModelOf(index, in hit).IsSolid && _caster.TryFindNearest(back, context, out var twin, 0, 2 * offset, footprint)
            && ModelOf(context.ObjectIndex, in twin).IsSolid && !IsInnerSide(in twin, context.ObjectIndex);
    }

    private bool IsInnerSide(in RayHit hit, int index) =>
        ModelOf(index, in hit).IsSolid && hit.IsFrontFace == hit.InstanceMap.Linear.Determinant() < 0;

    private TracedModel ModelOf(int index, in RayHit hit) => PartOf(_models[_zoom?.ObjectIndex ?? index], in hit);

    private static T PartOf<T>(T[] parts, in RayHit hit) => parts.Length == 1 ? parts[0] : parts[hit.MeshIndex];

    /// <summary>Computes the part of light that reaches a point from a direction, from 0 to 1.</summary>
    /// <param name="ray">From the point towards the light.</param>
    /// <param name="footprint">How wide the ray is.</param>
    /// <param name="distance">Distance of the light.</param>
    /// <param name="context">Lends its memory.</param>
    public double Transmittance(Ray ray, RayFootprint footprint, double distance, QueryContext context) =>
        Transmittance(ray, footprint, distance, context, out _);

    /// <summary>Likewise, and tells whether any light passes solid glass, which bends other rays.</summary>
    public double Transmittance(Ray ray, RayFootprint footprint, double distance, QueryContext context, out bool passesGlass)
    {
        var minDistance = 0.0;
        passesGlass = false;
        if (Lamps?.FindNearest(in ray, minDistance, ref distance) is not null)
        {
            return 0;
        }

        if (_section is { } section && !section.TryClip(in ray, ref minDistance, ref distance))
        {
            return 1;
        }

        if (!IsSeeThrough)
        {
            return _caster.HitsAny(ray, context, minDistance, distance, footprint) ? 0 : 1;
        }

        const int MaxLayers = 32;
        var transmittance = 1.0;
        for (var layer = 0; transmittance > 0 && TryIntersectObjects(in ray, footprint, 0, distance, context, out var surface); layer++)
        {
            transmittance *= layer < MaxLayers ? 1 - surface.Opacity : 0;
            passesGlass |= surface.Glass is not null;
            var passed = (surface.Position - ray.Origin).Length() + OffsetAt(surface.Position);
            ray = ray with { Origin = ray.Origin + (passed * ray.Direction) };
            distance -= passed;
            if (!(distance > 0))
            {
                break;
            }
        }

        return transmittance;
    }

    /// <summary>Looks up the surface of a hit.</summary>
    /// <param name="direction">Direction of the ray.</param>
    /// <param name="hit">The hit.</param>
    /// <param name="index">Index of the object, or in a deep zoom of the sub-fractal.</param>
    /// <param name="context">Has the path to the instance.</param>
    private TracedSurface CreateSurface(Vector direction, in RayHit hit, int index, QueryContext context)
    {
        var model = ModelOf(index, in hit);
        var material = model.MaterialOf(hit.FaceIndex);
        var map = hit.InstanceMap;
        var faceNormal = hit.IsFrontFace ? hit.Normal : -hit.Normal;
        var normal = OrientedNormal(
            map.Linear.Cofactors() * model.InterpolateNormal(hit.FaceIndex, hit.Barycentrics), faceNormal, direction);
        var (gloss, emission, glow) = (material.Gloss, material.Emission, 0.0);
        var colour = material.BaseColour?.Stretch(_tints[_zoom?.ObjectIndex ?? index])
            ?? ObjectColour(index, in hit, context, ref gloss, out glow);
        colour = colour.Stretch(model.InterpolateColour(hit.FaceIndex, hit.Barycentrics));
        colour = TintOf(index, context).Apply(colour);
        emission = glow > 0 ? glow * colour : emission;
        var opacity = material.Opacity;
        if (material.IsTextured && model.TryGetTextureTriangle(hit.FaceIndex, out var corners, out var coordinates))
        {
            var (weightA, weightB, weightC) = hit.Barycentrics;
            var (u, v, _) = (weightA * coordinates.A) + (weightB * coordinates.B) + (weightC * coordinates.C);
            if (material.Texture is { } texture)
            {
                var (texel, alpha) = texture.Sample(u, v);
                colour = colour.Stretch(texel);
                opacity = material.IsCutOut ? (alpha < 0.5 ? 0 : 1) : opacity * alpha;
            }

            normal = SurfaceDetail.Apply(material, normal, map.Linear, corners, coordinates, u, v, direction);
        }

        var glass = material.Glass is { } refracting && model.IsSolid ? refracting : null;
        // What is not scattered goes through.
        colour = glass is null ? colour : opacity * colour;
        return new(hit.Point, faceNormal, normal, colour, gloss, emission, opacity)
        {
            // What glows by a gradient is never sampled.
            FaceIndex = glow > 0 ? -1 : hit.FaceIndex,
            Glass = glass,
            IsInside = glass is not null && IsInnerSide(in hit, index),
        };
    }

    /// <summary>Brings an interpolated normal to the side that the ray comes from; the face's own where there is none.</summary>
    private static Vector OrientedNormal(Vector normal, Vector faceNormal, Vector direction)
    {
        var length = normal.Length();
        if (!(length > 0) || !double.IsFinite(length))
        {
            return faceNormal;
        }

        normal /= length;
        normal = Vector.Dot(normal, faceNormal) < 0 ? -normal : normal;
        // Seen from behind, an interpolated normal would turn away from the light.
        return Vector.Dot(normal, direction) < 0 ? normal : faceNormal;
    }

    /// <summary>What the maps of a fractal mix into the colour of an instance.</summary>
    private Tint TintOf(int index, QueryContext context) =>
        _objects[_zoom?.ObjectIndex ?? index].Model is not FractalModel { Fractal: { HasColours: true } fractal } ? Tint.None
        : _caster is DeepZoomRayCaster zoomed ? zoomed.TintOf(index, context)
        : Tint.Of(fractal, context.InstancePath);

    /// <summary>The colour of an instance of an object, or in a deep zoom of a sub-fractal.</summary>
    private Vector ObjectColour(int index, in RayHit hit, QueryContext context, ref Gloss? gloss, out double glow)
    {
        glow = 0;
        var objectIndex = _zoom?.ObjectIndex ?? index;
        var colour = PartOf(_colours[objectIndex], in hit);
        var placed = _objects[objectIndex];
        var zoomed = _caster as DeepZoomRayCaster;
        if (_gradients[objectIndex] is { } shading)
        {
            var shade = zoomed?.ShadeOf(shading, index, context) ?? shading.ShadeOf(context.InstancePath);
            glow = shading.Gradient.Glow?.At(shade.Factor) ?? 0;
            gloss = shading.Gradient.IsGlossy
                ? _gradientGloss[objectIndex][(int)Math.Round(shade.Factor * GradientGlossSteps)] : gloss;
            return shading.Gradient.Palette is null ? Mix(shade.Factor) : shade.Colour;
        }

        return placed.Gradient is { IsPlain: true, Kind: not GradientKind.None and var kind }
            && placed.Model is FractalModel { Fractal: var fractal }
            ? Mix(zoomed?.GradientFactorOf(kind, index, context) ?? ColourPath.GradientFactorOf(fractal, kind, context.InstancePath))
            : colour;

        Vector Mix(double factor) => ((1 - factor) * colour) + (factor * _gradientEnds[objectIndex]);
    }
}
