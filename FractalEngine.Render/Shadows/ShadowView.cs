using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Visibility.Frames;

namespace FractalEngine.Render.Shadows;

/// <summary>What a light sees: the view in which one depth map is drawn.</summary>
/// <param name="Position">Eye of the view: world space, or relative to the camera in a deep zoom.</param>
/// <param name="Axes">Columns are the unit axes to the right, up, and the way the light travels; their determinant is 1.</param>
/// <param name="IsPerspective">True for lights with a position.</param>
/// <param name="HalfWidth">Half the width that the map shows: at depth 1 in perspective, in scene units otherwise.</param>
/// <param name="HalfHeight">Half the height, likewise.</param>
/// <param name="Near">Depth of the near plane. Casters before it count as if they were on it where the light is parallel.</param>
/// <param name="Far">Depth of the far plane.</param>
/// <param name="CasterNear">Smallest depth of what casts within the scene's bounds; at most the near plane's.</param>
/// <param name="Size">Texels a side.</param>
internal readonly record struct ShadowView(
    Vector Position, Matrix Axes, bool IsPerspective, double HalfWidth, double HalfHeight, double Near, double Far, double CasterNear,
    int Size)
{
    /// <summary>Whether the light is dark, or lights nothing visible: drawn only where lights are not culled.</summary>
    public bool IsIdle { get; init; }

    /// <summary>Whether the view is one of the sides of a cube around a light.</summary>
    public bool IsCubeSide { get; init; }

    /// <summary>Plane that cuts the casters open, in world axes about the eye of the view; null for none.</summary>
    public SectionPlane? Section { get; init; }

    /// <summary>Size of a texel: at depth 1 in perspective, in scene units otherwise.</summary>
    public double TexelSize => 2 * Math.Max(HalfWidth, HalfHeight) / Size;

    /// <summary>The view in the form that culling takes.</summary>
    public CullingView ToCullingView() => new(
        Position, Axes, IsPerspective, HalfHeight, Size, Size, HalfWidth / HalfHeight, CasterNear, Far)
    {
        Section = Section,
    };

    /// <summary>
    /// Coefficients of z = ZByDepth·depth + Z and w = WByDepth·depth + W, so that z/w is 1 at the near plane and 0 at the far one.
    /// </summary>
    public (double ZByDepth, double Z, double WByDepth, double W) DepthScale => IsPerspective
        ? (-Near / (Far - Near), Far * Near / (Far - Near), 1, 0)
        : (-1 / (Far - Near), Far / (Far - Near), 0, 1);
}
