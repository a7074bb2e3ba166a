using FractalEngine.Core.Approximation.Elements;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Approximation.Damaged.Placements;

/// <summary>The elements of a damaged mesh, in classes of those that are images of one template within the noise.</summary>
internal sealed class DamagedModel
{
    // Radii of noise are about so many times the root of its mean square, with some room.
    private const double RadiusPerDeviation = 1.4;

    // Within this part of their size elements of unknown noise count as images of a template.
    private const double MaxNoiseOfSize = 0.1;

    // That part of decimated elements are connected in ways of their own.
    private const double MinUnlike = 0.2;

    private const double NearTolerance = 3e-3;

    // Files with seven digits have about so much noise, in diagonals.
    private const double MinNoise = 1e-7;

    private DamagedModel(Mesh mesh, double noise)
    {
        Diagonal = mesh.UsedBounds.Diagonal;
        Noise = Math.Max(noise, MinNoise * Diagonal);
        IsExact = Noise <= 10 * MinNoise * Diagonal;
        Centre = mesh.UsedBounds.Centre;
    }

    /// <summary>How far vertices may be from where they belong, scene units.</summary>
    public double Noise { get; }

    /// <summary>Whether there is no more noise than the digits of files explain.</summary>
    public bool IsExact { get; }

    /// <summary>Whether elements are placed by vertices that they share, and have fewer of these than what they are images of.</summary>
    public bool IsDecimated { get; private init; }

    /// <summary>Whether there are several elements, and noise that exact searches don't allow for.</summary>
    public bool IsNoisy => Noise > MinNoise * Diagonal && Elements.Count > 1;

    /// <summary>How far an element that belongs to a hypothesis may be off, in units of its size.</summary>
    public double Tolerance => IsExact ? 1e-3 : 0.12;

    /// <summary>How far it may be off while maps are not fitted yet, in units of its size.</summary>
    public double FirstTolerance => IsExact ? 1e-2 : 0.3;

    /// <summary>The diagonal of the mesh, scene units.</summary>
    public double Diagonal { get; }

    /// <summary>The centre of the mesh's box, scene units.</summary>
    public Vector Centre { get; }

    /// <summary>The templates of all classes.</summary>
    public List<ElementTemplate> Templates { get; } = [];

    /// <summary>The elements, larger ones first.</summary>
    public List<PlacedElement> Elements { get; } = [];

    /// <summary>Sorts the elements of a mesh into classes.</summary>
    /// <param name="mesh">The mesh.</param>
    /// <param name="noise">How far vertices may be from where they belong, scene units.</param>
    /// <param name="cancellation">Ends the work early.</param>
    public static DamagedModel Create(Mesh mesh, double noise, CancellationToken cancellation)
    {
        var model = new DamagedModel(mesh, noise);
        foreach (var group in Groups(mesh))
        {
            var classes = new List<int>();
            foreach (var (element, topology) in group)
            {
                cancellation.ThrowIfCancellationRequested();
                model.Sort(element, topology, classes);
            }
        }

        model.SortBySize();
        return model;
    }

    /// <summary>Sorts elements by vertices that they share, if most of them are connected like no other one; else returns null.</summary>
    public static DamagedModel? CreateOfDecimated(Mesh mesh, CancellationToken cancellation)
    {
        var groups = Groups(mesh).ToList();
        if (groups.Sum(group => group.Count) is var count && (count == 0 || groups.Count(group => group.Count == 1) < MinUnlike * count))
        {
            return null;
        }

        var model = new DamagedModel(mesh, 0) { IsDecimated = true };
        var elements = groups.SelectMany(group => group).Select(pair => pair.Element).Where(element => !element.Shape.IsFlat);
        foreach (var found in DecimatedClass.Find([.. elements.Select(element => new DecimatedElement(element))], cancellation))
        {
            var template = new ElementTemplate(found.First, found.Symmetries, out var frame);
            foreach (var (_, map) in found.Members)
            {
                model.Elements.Add(new(model.Templates.Count, map.Inverse() * frame, []));
            }

            model.Templates.Add(template);
        }

        model.SortBySize();
        return model.Elements.Count > 1 ? model : null;
    }

    /// <summary>
    /// Estimates the noise from how far elements are from images of the largest ones that are connected alike; null where any would be.
    /// </summary>
    public static double? EstimateNoise(Mesh mesh, CancellationToken cancellation)
    {
        var deviations = new List<double>();
        foreach (var group in Groups(mesh).Where(group => group.Count > 2))
        {
            var (first, topology) = group[0];
            var template = new ElementTemplate(first, topology, first.Shape, 0);
            foreach (var (element, other) in group.Skip(1).Where(_ => template.FreeNumbers > 0))
            {
                cancellation.ThrowIfCancellationRequested();
                if (template.Place(0, element, other) is { } placed && placed.Error < MaxNoiseOfSize * element.Shape.Size)
                {
                    deviations.Add(placed.Error * Math.Sqrt(3.0 * element.Shape.Points.Length / template.FreeNumbers));
                }
            }
        }

        return deviations.Count == 0 ? null : RadiusPerDeviation * deviations.Order().ElementAt(deviations.Count / 2);
    }

    /// <summary>Whether two maps are one: they differ little in entries, and in what they make of the model's centre.</summary>
    public bool AreNear(AffineMap map1, AffineMap map2) => (map1.Linear - map2.Linear).MaxAbsEntry() < NearTolerance
        && ((map1 * Centre) - (map2 * Centre)).MaxAbsComponent() < NearTolerance * Diagonal;

    /// <summary>Makes an index of placements with tolerances.</summary>
    /// <param name="relative">Largest distance in units of the placement's size.</param>
    public PlacementIndex CreateIndex(double relative) => new(Templates, relative, 3 * Noise);

    /// <summary>Makes an index of all elements, in their order.</summary>
    /// <inheritdoc cref="CreateIndex"/>
    public PlacementIndex CreateFullIndex(double relative)
    {
        var index = CreateIndex(relative);
        Elements.ForEach(element => index.Add(element.Class, element.Placement));
        return index;
    }

    /// <summary>Elements that are connected alike, with the largest one first.</summary>
    private static IEnumerable<List<(Element Element, ElementTopology Topology)>> Groups(Mesh mesh) =>
        ElementFinder.Find(mesh, weldPositions: false)
            .Select(element => (Element: element, Topology: new ElementTopology(element.Corners, element.Shape.Points.Length)))
            .GroupBy(pair => pair.Topology.Key).Select(group => group.OrderByDescending(pair => pair.Element.Shape.Size).ToList());

    private void SortBySize() => Elements.Sort((first, second) =>
        PlacedElement.SizeOf(second.Placement).CompareTo(PlacedElement.SizeOf(first.Placement)) is var order && order != 0 ? order
        : first.Placement.Translation.X.CompareTo(second.Placement.Translation.X));

    private void Sort(Element element, ElementTopology topology, List<int> classes)
    {
        foreach (var known in classes)
        {
            if (Templates[known].Place(known, element, topology) is { } placed && placed.Error <= 2 * Noise)
            {
                Elements.Add(placed.Element);
                return;
            }
        }

        // Where more than two faces meet at edges, faces don't even correspond to themselves.
        if (ElementShape.Create(element.Shape.Points, Noise) is { } shape
            && new ElementTemplate(element, topology, shape, 4 * Noise) is var template
            && template.Place(Templates.Count, element, topology) is { } own)
        {
            classes.Add(Templates.Count);
            Templates.Add(template);
            Elements.Add(own.Element);
        }
    }
}
