using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics.Descriptions;

/// <summary>Which things meet: each is in one of 32 layers, and has a mask of the layers that it meets.</summary>
internal static class Layers
{
    /// <summary>Number of layers, numbered from 0.</summary>
    public const int Count = 32;

    /// <summary>The mask of what meets everything, which things have unless stated otherwise.</summary>
    public const uint All = uint.MaxValue;

    /// <summary>Throws for a layer that there is not.</summary>
    /// <exception cref="ArgumentOutOfRangeException">The layer is not from 0 to 31.</exception>
    public static void Require(int layer, string parameterName) =>
        ArgumentCheck.RequireInRange(layer is >= 0 and < Count, layer, "expected a layer from 0 to 31", parameterName);

    /// <summary>Two things meet when the mask of each has the other's layer.</summary>
    public static bool CanMeet(int layer1, uint mask1, int layer2, uint mask2) =>
        (mask1 & (1u << layer2)) != 0 && (mask2 & (1u << layer1)) != 0;
}
