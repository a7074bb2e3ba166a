using System.Runtime.InteropServices;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals.Levels;

/// <summary>The maps of a transformation set with the terms a search needs. All levels with the same set share it.</summary>
internal sealed class MapSet
{
    // Computed twice at worst, with the same result.
    private AffineMap[]? _inverses;
    private long[]? _sizes;

    /// <summary>Computes the terms of a transformation set.</summary>
    /// <exception cref="SingularMatrixException">A map has no inverse.</exception>
    public MapSet(TransformationSet set)
        // Shared, since nothing writes into it: wide sets take much memory.
        : this(ImmutableCollectionsMarshal.AsArray(set.Maps)!, ImmutableCollectionsMarshal.AsArray(set.Colours)!) =>
        IsPlacement = set.IsPlacement;

    /// <summary>Computes the terms of some maps.</summary>
    /// <exception cref="SingularMatrixException">A map has no inverse.</exception>
    public MapSet(AffineMap[] maps, params MapColour[] colours)
    {
        Maps = maps;
        Colours = colours.All(static one => one.IsNone) ? [] : colours;
        ScalesSquared = new double[maps.Length];
        OperatorNormBounds = new double[maps.Length];
        IdentityIndex = -1;
        AreSimilarities = true;
        for (var i = 0; i < maps.Length; i++)
        {
            var map = maps[i];
            // Only to find out whether there is one.
            map.Inverse();
            ScalesSquared[i] = map.Linear.V1.LengthSquared();
            OperatorNormBounds[i] = BoundingSphere.OperatorNormBound(map.Linear) * (1 + RoundingErrors.Norm);
            AreSimilarities &= map.Linear.IsChainableSimilarity();
            IdentityIndex = IdentityIndex < 0 && IsIdentity(i) ? i : IdentityIndex;
        }
    }

    /// <summary>How a chain of the fractal's own maps replaces the map of this set; null where the set is one of the fractal's.</summary>
    public MapPower? Power { get; init; }

    /// <summary>True where each map is that of a call: it leads to a recursive of its own, and skips no level by an identity.</summary>
    public bool IsOfCalls { get; init; }

    /// <summary>True where the map moves the fractal as a whole.</summary>
    public bool IsPlacement { get; }

    /// <summary>Decides which one of the calls stands at a place; null where all do.</summary>
    public LevelPick? Pick { get; init; }

    /// <summary>For each call its number as chance counts; none for sets that are no calls.</summary>
    public (int Term, int Map)[] Numbers { get; init; } = [];

    /// <summary>The set that contains the identity alone.</summary>
    public static MapSet Identity { get; } = new([AffineMap.Identity]);

    /// <summary>The set of an edge that leads to where the levels below a part go on, and is no part of a path.</summary>
    public static MapSet Link { get; } = new([AffineMap.Identity]);

    /// <summary>The maps in the order of the set.</summary>
    public AffineMap[] Maps { get; }

    /// <summary>The inverses of the maps, computed at the first use: they are as large as the maps, and few searches need them.</summary>
    public AffineMap[] Inverses => _inverses ??= Array.ConvertAll(Maps, static map => map.Inverse());

    /// <summary>What each map mixes into the colours of what it makes; empty where none does.</summary>
    public MapColour[] Colours { get; }

    /// <summary>Tells whether a map changes nothing: neither places nor colours.</summary>
    public bool IsIdentity(int index) => Maps[index] == AffineMap.Identity && ColourOf(index).IsNone;

    /// <summary>What a map mixes into the colours of what it makes.</summary>
    public MapColour ColourOf(int index) => Colours.Length == 0 ? default : Colours[index];

    /// <summary>Squares of the factors by which the maps lengthen vectors; meaningful for similarities only.</summary>
    public double[] ScalesSquared { get; }

    /// <summary>Upper bounds of the factors by which the maps lengthen vectors.</summary>
    public double[] OperatorNormBounds { get; }

    /// <summary>Index of the first identity in the set; −1 for none.</summary>
    public int IdentityIndex { get; }

    /// <summary>True when all maps are similarities.</summary>
    public bool AreSimilarities { get; }

    /// <summary>The way through one of the maps.</summary>
    public WrittenWay WayOf(int index) =>
        IsPlacement || Pick is { DependsOnSize: true } || (!IsOfCalls && Maps.Length == 1 && IdentityIndex == 0)
            ? WrittenWay.Empty
        : Pick is not null ? WrittenWay.Of(index)
        : Numbers.Length > 0 ? WrittenWay.Of(Numbers[index].Term, Numbers[index].Map)
        : WrittenWay.Of(0, index);

    /// <summary>How much smaller one of the maps makes things, see <see cref="StretchSize"/>.</summary>
    public long SizeOf(int index) => IsPlacement ? 0 : (_sizes ??= Array.ConvertAll(Maps, static map => StretchSize.Of(map.Linear)))[index];

    /// <summary>Number of bytes of the arrays.</summary>
    public long StorageBytes => Maps.Length * (_inverses is null ? 14 : 26) * sizeof(double);
}
