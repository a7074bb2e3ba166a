using System.Collections.Immutable;
using FractalEngine.Core.DeepZoom;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Visibility.Levels;

namespace FractalEngine.Render.Views;

/// <summary>
/// Describes a camera so deep inside an object that its position is given relative to a sub-fractal, see <see cref="FractalAddress"/>.
/// </summary>
/// <param name="ObjectIndex">Index of the object in the scene, from 0. No other object is drawn.</param>
/// <param name="Roots">Sub-fractals that culling starts from, in world axes about the camera, in the unit of the address.</param>
/// <param name="LogUnit">Natural logarithm of the unit of <see cref="Roots"/>, that unit being a length in scene units.</param>
public sealed record DeepZoom(int ObjectIndex, ImmutableArray<LodRoot> Roots, double LogUnit)
{
    /// <summary>Tells whether two cameras see the same, whenever their sub-fractals were collected.</summary>
    public bool Equals(DeepZoom? other) =>
        other is not null && ObjectIndex == other.ObjectIndex && LogUnit == other.LogUnit
        && Roots.AsSpan().SequenceEqual(other.Roots.AsSpan());

    /// <inheritdoc/>
    public override int GetHashCode() => HashCode.Combine(ObjectIndex, LogUnit, Roots.Length);

    /// <summary>Moves the roots from the camera to an eye beside it.</summary>
    /// <param name="eye">Position relative to the camera, in the unit of the address.</param>
    internal DeepZoom AboutEye(Vector eye) => this with
    {
        Roots = [.. Roots.Select(root => root with
        {
            FrameToCamera = root.FrameToCamera with { Translation = root.FrameToCamera.Translation - eye },
        })],
    };
}
