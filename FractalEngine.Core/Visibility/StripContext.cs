using System.Runtime.Intrinsics;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Visibility.Frames;
using FractalEngine.Core.Visibility.Levels;

namespace FractalEngine.Core.Visibility;

/// <summary>The context of one run of culling: the parameters of the strip and of one object, and the output.</summary>
/// <remarks>It lives on the stack while an object is culled, so that the culler itself keeps no state between runs.</remarks>
/// <param name="frame">Parameters of the strip.</param>
/// <param name="item">Object that is culled.</param>
/// <param name="output">Receives the visible instances.</param>
/// <param name="viewToFractal">Map from view space to the frame of the fractal; any where places don't decide about colours.</param>
internal readonly ref struct StripContext(
    ref readonly StripFrame frame, CulledObject item, StripOutput output, SimdAffineMap viewToFractal = default)
{
    private readonly ref readonly StripFrame _frame = ref frame;

    /// <summary>Parameters of the strip.</summary>
    public ref readonly StripFrame Frame => ref _frame;

    /// <summary>Level-of-detail hierarchy of the object.</summary>
    public LodHierarchy Hierarchy { get; } = item.Hierarchy;

    /// <summary>Base mesh of the object, for the occlusion buffer.</summary>
    public OccluderMesh Occluder { get; } = item.Hierarchy.Occluder;

    /// <summary>Point of the base mesh's frame that the drawn vertices are relative to: x, y, z, 0.</summary>
    public Vector256<double> VertexOrigin { get; } = SimdAffineMap.ToVector256(item.VertexOrigin);

    /// <summary>Winding of the base mesh, see <see cref="CulledObject.WindingSign"/>.</summary>
    public int WindingSign { get; } = item.WindingSign;

    /// <summary>Whether instances of the object are rasterized into the occlusion buffer.</summary>
    public bool CanOcclude { get; } = item.IsOpaque && item.Hierarchy.Occluder.VertexIndices.Length > 0;

    /// <summary>Kind of the object's gradient.</summary>
    public GradientKind Gradient { get; } = item.GradientKind;

    /// <summary>What tells the colours of the object's gradient; null where their kind does.</summary>
    public InstanceGradient? Shading { get; } = item.Shading;

    /// <summary>Map from view space to the frame of the fractal; any where places don't decide about colours.</summary>
    public SimdAffineMap ViewToFractal { get; } = viewToFractal;

    /// <summary>Whether instances come with tints.</summary>
    public bool HasColours { get; } = item.Hierarchy.HasColours;

    /// <summary>Whether instances come with the parts of the sky that they see.</summary>
    public bool HasSkyParts { get; } = frame.HasSkyVisibility && item.HasSkyMasks;

    /// <summary>Receiver of the visible instances and the statistics.</summary>
    public StripOutput Output { get; } = output;
}
