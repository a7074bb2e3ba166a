using System.Text.Json;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Scenes;
using FractalEngine.Render.Drawables;
using FractalEngine.Render.Gl;
using FractalEngine.Render.Gl.State;
using FractalEngine.Render.Lights;
using FractalEngine.Render.Upload;
using FractalEngine.Render.Windowing;
using OpenTK.Graphics.OpenGL4;

namespace FractalEngine.Render.Frame;

/// <summary>The program for one combination of <see cref="MeshFeatures"/>, with its uniforms.</summary>
internal sealed class MeshProgram : ShaderProgram
{
    private readonly RedundancyFilter _filter;
    private readonly MaterialUniforms _materialUniforms;
    private readonly int _sectionLocation;
    private long _lastFrame;
    private bool? _lastWireframe;
    private SectionPlane? _lastSection;
    private CullFace? _lastInnerFace;
    private Gradient? _lastGradient;

    /// <summary>Compiles and links the program.</summary>
    /// <param name="context">Current context.</param>
    /// <param name="features">What the program shows.</param>
    /// <param name="lightSymbols">Number and kinds of the lights: <see cref="LightBlock.SymbolsOf"/>.</param>
    /// <exception cref="GlException">The driver refuses the program.</exception>
    public MeshProgram(RenderContext context, MeshFeatures features, IReadOnlyList<string> lightSymbols)
        : base(context.Resources, "mesh", [.. SymbolsOf(features), .. lightSymbols])
    {
        _filter = context.Resources.State.Filter;
        BindBlock("ObjectBlock", GlState.ObjectBinding);
        BindBlock("LightBlock", GlState.LightBinding);
        if (features.HasFlag(MeshFeatures.Shadows))
        {
            BindBlock("ShadowBlock", GlState.ShadowBinding);
        }

        View = new(this, _filter, context.HasReversedDepth);
        _sectionLocation = UniformLocation("section");
        Use();
        Set("surfaceTexture", 0);
        Set("shadowMap", GlState.ShadowTextureUnit);
        Set("detailTexture", GlState.DetailTextureUnit);
        Set("facetAlbedo", GlState.FacetTextureUnit);
        Set("surroundings", GlState.SurroundingsTextureUnit);
        Set("probe", GlState.ProbeTextureUnit);
        Set("probeDepths", GlState.ProbeDepthTextureUnit);
        _materialUniforms = new(this, _filter);
    }

    /// <summary>The camera uniforms of this program.</summary>
    public ViewUniforms View { get; }

    /// <summary>Returns the symbols that switch features on in mesh.vert and mesh.frag: their names, as in <c>PER_PIXEL</c>.</summary>
    public static IEnumerable<string> SymbolsOf(MeshFeatures features) => Enum.GetValues<MeshFeatures>()
        .Where(feature => feature != MeshFeatures.None && features.HasFlag(feature))
        .Select(static feature => JsonNamingPolicy.SnakeCaseUpper.ConvertName(feature.ToString()));

    /// <summary>Notes the number of a frame. Returns false where the program has the view of that frame already.</summary>
    public bool BeginFrame(long number) => _filter.Update(ref _lastFrame, number);

    /// <summary>Sets the colour of wireframe edges, or lit surfaces. The program must be in use.</summary>
    public void SetWireframe(bool wireframe, Colour colour)
    {
        if (_filter.Update(ref _lastWireframe, wireframe))
        {
            var (red, green, blue) = colour.ToLinear();
            Set("flatColour", red, green, blue, wireframe ? 1 : 0);
        }
    }

    /// <summary>Sets the plane that cuts the scene open, in world axes about the camera. The program must be in use.</summary>
    public void SetSection(SectionPlane section)
    {
        if (_filter.Update(ref _lastSection, section))
        {
            ViewUniforms.SetSection(_sectionLocation, section);
        }
    }

    /// <summary>Sets which face of triangles is inside a solid; none to leave sections hollow. The program must be in use.</summary>
    public void SetInnerFace(CullFace face)
    {
        if (_filter.Update(ref _lastInnerFace, face))
        {
            Set("innerFace", face == CullFace.None ? 0.0 : face == CullFace.Back ? -1.0 : 1.0);
        }
    }

    /// <summary>Sets the material of the next draw calls. The program must be in use.</summary>
    /// <param name="material">Null for the object's own colour.</param>
    /// <param name="tint">Colour that multiplies the material's own, sRGB.</param>
    public void SetMaterial(DrawableMaterial? material, Colour tint) => _materialUniforms.Set(material?.Material, tint);

    /// <summary>Sets the gradient of the next draw calls. The program must be in use, and have <see cref="MeshFeatures.Graded"/>.</summary>
    public void SetGradient(Gradient gradient)
    {
        if (_filter.Update(ref _lastGradient, gradient))
        {
            GL.Uniform4(UniformLocation("gradedSteps"), GradedSurface.StepCount, GradedSurface.ToUniforms(gradient));
            Set("gradedCoat", GradedSurface.CoatOf(gradient));
            var (metal, glow) = (gradient.Metalness ?? default, gradient.Glow ?? default);
            Set("gradedEnds", metal.First, metal.Last, glow.First, glow.Last);
        }
    }
}
