using System.Collections.Immutable;
using System.Globalization;
using System.Text;
using FractalEngine.Core.DeepZoom;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Rays;
using FractalEngine.Core.Scenes;
using FractalEngine.Render.Lines;
using FractalEngine.Render.Views;

namespace FractalEngine.App.Window.Tools;

/// <summary>What the user has clicked, a face of an object with the part of it that is selected, or an object chosen from a list.</summary>
/// <param name="ObjectIndex">Index of the object in the scene, from 0. Balls that were dropped come after the scene's objects.</param>
/// <param name="Object">The object with its model.</param>
/// <param name="Path">Index of the transformation at each level of a fractal, the outermost first; empty for a mesh.</param>
/// <param name="Depth">Number of levels of the path that are selected: 0 for the whole object.</param>
/// <param name="Hit">
/// The point that was clicked, in the frame that <paramref name="Viewpoint"/> tells; null for an object chosen from a list.
/// </param>
/// <param name="Viewpoint">
/// Null where the hit is in world space. Else the address of the camera at the click, about which the hit is given in the unit of the
/// address, since the camera was too deep in a fractal for world space. It belongs to the sub-fractal that the ray met.
/// </param>
internal sealed record Selection(
    int ObjectIndex, PlacedModel Object, ImmutableArray<int> Path, int Depth, RayHit? Hit, FractalAddress? Viewpoint = null)
{
    // Of a longer path, panels show the end.
    private const int MaxShownLevels = 24;

    private static readonly Colour OutlineColour = new(1, 0.72, 0.2);
    private static readonly Colour FaceColour = new(1, 1, 1);
    private static readonly Colour NormalColour = new(0.3, 0.9, 1);

    /// <summary>
    /// Box around the selected part, in its own frame, with the map from there to the frame of the hit. It is empty where the part is too
    /// large to be told there.
    /// </summary>
    public (BoundingBox Box, AffineMap Map) Outline { get; private init; } = ComputeOutline(Object, Path, Depth, Hit, Viewpoint);

    /// <summary>The clicked instance, and its map to the frame of the hit; null for a fractal that was chosen from a list.</summary>
    public (Mesh Mesh, AffineMap Map)? Instance =>
        (Hit?.InstanceMap ?? (Object.Model is MeshModel ? Object.ObjectToWorld : null)) is { } map ? (Part.Mesh, map) : null;

    /// <summary>The model, or what of it shows the mesh with the clicked face.</summary>
    public Model Part => FractalSelection.PartOf(Object.Model, Hit);

    /// <summary>The clicked point, in the frame of the hit; the middle of an object chosen from a list.</summary>
    public Vector Point => Hit?.Point ?? Object.Bounds.Centre;

    /// <summary>The clicked point in world space, as far as a double can tell it.</summary>
    public Vector WorldPoint => Viewpoint is null ? Point
        : Viewpoint.WorldPosition(Object.ObjectToWorld) + (Math.Exp(Viewpoint.LogUnit) * Point);


    /// <summary>Selects a whole object of the scene.</summary>
    public static Selection OfObject(int index, PlacedModel placed) => new(index, placed, [], 0, null);

    /// <summary>Selects the sub-fractal that the selected part belongs to; the same selection where that is a whole object.</summary>
    public Selection Up() =>
        Depth > 0 ? this with { Depth = Depth - 1, Outline = ComputeOutline(Object, Path, Depth - 1, Hit, Viewpoint) } : this;

    /// <summary>Selects the same part after the object was moved, or its model changed.</summary>
    /// <returns>Null where the object has no such part any more.</returns>
    public Selection? ContinueIn(PlacedModel placed)
    {
        var isSameModel = ReferenceEquals(placed.Model, Object.Model);
        if (isSameModel && placed.ObjectToWorld == Object.ObjectToWorld)
        {
            return this with { Object = placed };
        }

        if (Viewpoint is not null)
        {
            // The address is one of the fractal as it was.
            return null;
        }

        if (Hit is not { } hit)
        {
            return OfObject(ObjectIndex, placed);
        }

        if (placed.Model.Parts.Length != Object.Model.Parts.Length)
        {
            return null;
        }

        var mesh = FractalSelection.PartOf(placed.Model, hit).Mesh;
        if (!isSameModel && (placed.Model.SourcePath != Object.Model.SourcePath || mesh.FaceCount != Part.Mesh.FaceCount))
        {
            return null;
        }

        if (MapOfInstance(placed, hit) is not { } map)
        {
            return null;
        }

        var (a, b, c) = mesh.Face(hit.FaceIndex);
        var (x, y, z) = hit.Barycentrics;
        var normal = Vector.Cross(map.Linear * (b - a), map.Linear * (c - a));
        hit = hit with
        {
            InstanceMap = map,
            Point = map * ((x * a) + (y * b) + (z * c)),
            Normal = normal.Length() > 0 ? normal.UnitVector() : hit.Normal,
        };
        return this with { Object = placed, Hit = hit, Outline = ComputeOutline(placed, Path, Depth, hit, null) };
    }

    /// <summary>Returns the map of the instance at the path from the frame of its mesh to world space; null where there is none.</summary>
    private AffineMap? MapOfInstance(PlacedModel placed, in RayHit hit)
    {
        if (placed.Model is not FractalModel { Fractal: var fractal })
        {
            return placed.ObjectToWorld;
        }

        if (fractal.Description.Composition != Composition.Affine)
        {
            return ReferenceEquals(placed.Model, Object.Model)
                ? placed.ObjectToWorld * Object.ObjectToWorld.Inverse() * hit.InstanceMap : null;
        }

        return FractalSelection.MapOfInstance(fractal, Path, placed.ObjectToWorld);
    }

    /// <summary>Adds lines around the selected part, and those of the clicked face and its normal, in the frame of the hit.</summary>
    public void AddLines(List<LineSegment> lines)
    {
        BoxLines.Add(lines, Outline.Box, Outline.Map, OutlineColour);
        if (Hit is not { } hit)
        {
            return;
        }

        var face = Part.Mesh.Face(hit.FaceIndex);
        var (a, b, c) = (hit.InstanceMap * face.A, hit.InstanceMap * face.B, hit.InstanceMap * face.C);
        lines.Add(new(a, b, FaceColour));
        lines.Add(new(b, c, FaceColour));
        lines.Add(new(c, a, FaceColour));
        var size = Math.Max((b - a).Length(), (c - a).Length());
        lines.Add(new(hit.Point, hit.Point + (0.5 * size * hit.Normal), NormalColour));
    }

    /// <summary>Names the selected part.</summary>
    public string Title => Depth == 0
        ? Object.Declaration.DisplayName
        : string.Create(CultureInfo.InvariantCulture, $"{Object.Declaration.DisplayName}, level {Depth} of {Path.Length}");

    /// <summary>Lists what is known about the selection, as names and values.</summary>
    public ImmutableArray<(string Name, string Value)> Facts =>
    [
        ("object", string.Create(CultureInfo.InvariantCulture, $"{Object.Declaration.DisplayName} ({ObjectIndex})")),
        ("selected", Depth == 0 ? "the whole object"
            : string.Create(CultureInfo.InvariantCulture, $"{(Depth == Path.Length ? "instance" : "sub-fractal")} at level {Depth}")),
        .. Path.IsEmpty ? [] : ((string, string)[])[("instance", PathText(MaxShownLevels))],
        .. Hit is { } hit ? FactsOf(hit) : FactsOf(Object.Bounds),
    ];

    /// <summary>All facts as lines of text, with all digits.</summary>
    public string ToText()
    {
        var text = new StringBuilder();
        foreach (var (name, value) in Facts)
        {
            text.Append(name).Append(": ").Append(name == "instance" ? PathText(Path.Length) : value).Append('\n');
        }

        return text.ToString();
    }

    private (string Name, string Value)[] FactsOf(in RayHit hit)
    {
        var face = hit.FaceIndex;
        var material = Part.Mesh.Groups.LastOrDefault(group => group.FirstFace <= face)?.Material;
        return
        [
            ("face", face.ToString(CultureInfo.InvariantCulture)),
            .. Object.Model.Parts.Length > 1 ? [("mesh", Object.Model.MeshNameAt(hit.MeshIndex))] : ((string, string)[])[],
            ("point", Format(WorldPoint)),
            ("normal", Format(hit.Normal)),
            ("material", string.IsNullOrEmpty(material) ? "none" : material),
            ("distance", ScaledNumber.Format(hit.Distance, Viewpoint?.LogUnit ?? 0, 9)),
        ];
    }

    private static (string Name, string Value)[] FactsOf(BoundingBox bounds) =>
        bounds.IsEmpty ? [("size", "empty")] : [("middle", Format(bounds.Centre)), ("size", Format(bounds.Size))];

    private string PathText(int maxLevels) =>
        (Path.Length > maxLevels ? "…" : "") + string.Join('.', Path.Skip(Path.Length - maxLevels));

    private static string Format(Vector vector) =>
        string.Create(CultureInfo.InvariantCulture, $"({vector.X:G9}, {vector.Y:G9}, {vector.Z:G9})");

    private static (BoundingBox Box, AffineMap Map) ComputeOutline(
        PlacedModel placed, ImmutableArray<int> path, int depth, RayHit? hit, FractalAddress? viewpoint)
    {
        if (depth > 0 && depth == path.Length && hit is { } clicked)
        {
            return (FractalSelection.PartOf(placed.Model, clicked).Mesh.Bounds, clicked.InstanceMap);
        }

        // In componentwise composition a sub-fractal has no map of its own.
        if (placed.Model is not FractalModel { Fractal: { Description.Composition: Composition.Affine } fractal }
            || (depth == 0 && viewpoint is null))
        {
            return (placed.Model.Bounds, placed.ObjectToWorld);
        }

        if (viewpoint is not null && depth <= viewpoint.Depth)
        {
            return viewpoint.SubFractalAt(depth) ?? (BoundingBox.Empty, AffineMap.Identity);
        }

        var (map, firstStep) = viewpoint is null ? (placed.ObjectToWorld, 0) : (viewpoint.FrameToCamera, viewpoint.Depth);
        return FractalSelection.SubFractalAt(fractal, path[..depth], firstStep, map) ?? (BoundingBox.Empty, AffineMap.Identity);
    }
}
