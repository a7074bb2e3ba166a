using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Render.Gl;
using FractalEngine.Render.Gl.State;
using FractalEngine.Render.Upload;
using OpenTK.Graphics.OpenGL4;

namespace FractalEngine.Render.Shadows;

/// <summary>The program that draws depths alone, with or without holes of a texture.</summary>
internal sealed class CasterProgram : ShaderProgram
{
    private static readonly SectionPlane Uncut = new(Vector.Zero, 1);

    private readonly int _sectionLocation;
    private readonly float[] _rows = new float[9];

    /// <summary>Compiles and links the program.</summary>
    /// <param name="resources">Resources of the current context.</param>
    /// <param name="isRelative">Whether instances are given in world axes about the eye.</param>
    /// <param name="isCutOut">Whether a texture cuts holes.</param>
    /// <exception cref="GlException">The driver refuses the program.</exception>
    public CasterProgram(GlResources resources, bool isRelative, bool isCutOut)
        : base(resources, "shadow", [.. isRelative ? (string[])["CAMERA_RELATIVE"] : [], .. isCutOut ? (string[])["CUT_OUT"] : []])
    {
        if (!isRelative)
        {
            BindBlock("ObjectBlock", GlState.ObjectBinding);
        }

        _sectionLocation = UniformLocation("section");
        Use();
        Set("surfaceTexture", 0);
    }

    /// <summary>Makes the program current, and sets the view of a light.</summary>
    public void SetView(in ShadowView view)
    {
        Use();
        ViewUniforms.WriteRows(view.Axes.Transpose(), _rows);
        GL.Uniform3(UniformLocation("lightAxes"), 3, _rows);
        Set("viewScale", 1 / view.HalfWidth, 1 / view.HalfHeight);
        var (zByDepth, z, wByDepth, w) = view.DepthScale;
        Set("depthScale", zByDepth, z, wByDepth, w);
        // The last section may still be set, and Mesa's llvmpipe cuts by it also where that is off.
        ViewUniforms.SetSection(_sectionLocation, view.Section ?? Uncut);
    }

    /// <summary>Sets how texture coordinates are moved. The program must be in use.</summary>
    public void SetTexture(MaterialTexture texture) =>
        Set("textureTransform", texture.Scale.U, texture.Scale.V, texture.Offset.U, texture.Offset.V);
}
