using System.Runtime.InteropServices;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Render.Gl;
using FractalEngine.Render.Preparation;
using OpenTK.Graphics.OpenGL4;

namespace FractalEngine.Render.Passes;

/// <summary>Balls that are no objects of the scene, in one draw call. Their places are uploaded anew for each picture.</summary>
internal sealed class SphereBatch : IDisposable
{
    private const int FaceCount = 1280;

    private readonly ModelBuffers _modelBuffers;
    private readonly GlBuffer _instances;
    private readonly VertexArray _vertexArray;
    private readonly ObjectBlock _objectBlock;
    private readonly List<float> _rows = [];

    /// <summary>Uploads a sphere.</summary>
    public SphereBatch(GlResources resources)
    {
        var scene =
            new LoadedScene(new Scene(),
            [new(new SceneObject("ball", Transformation.Identity),
            new MeshModel(MeshGenerators.Create("icosphere", 0, FaceCount)) { SourcePath = "ball" })]);
        _modelBuffers = new(resources, DrawableScene.Prepare(scene, new() { Culling = null }).Models[0]);
        _instances = new(resources, "balls", BufferTarget.ArrayBuffer);
        _vertexArray = new(resources, "balls");
        _modelBuffers.Attach(_vertexArray, _instances);
        _objectBlock = new(resources, "balls");
    }

    /// <summary>The program for them must be in use when this is drawn.</summary>
    /// <param name="spheres">All.</param>
    /// <param name="cameraPosition">World space.</param>
    /// <param name="colour">sRGB.</param>
    public void Draw(IReadOnlyList<SphereInstance> spheres, Vector cameraPosition, Colour colour)
    {
        _rows.Clear();
        foreach (var (centre, radius) in spheres)
        {
            var (r, (x, y, z)) = ((float)radius, centre - cameraPosition);
            _rows.AddRange([r, 0, 0, (float)x, 0, r, 0, (float)y, 0, 0, r, (float)z]);
        }

        _instances.Discard(_rows.Count * sizeof(float));
        _instances.Write(CollectionsMarshal.AsSpan(_rows), 0);
        _objectBlock.Bind(MeshPass.ObjectBinding, AffineMap.Translate(cameraPosition), colour, colour, cameraPosition);
        _vertexArray.Bind();
        GL.DrawElementsInstanced(PrimitiveType.Triangles, _modelBuffers.WholeMesh.IndexCount, DrawElementsType.UnsignedInt, IntPtr.Zero,
            spheres.Count);
    }

    /// <inheritdoc/>
    public void Dispose()
    {
        _vertexArray.Dispose();
        _instances.Dispose();
        _objectBlock.Dispose();
        _modelBuffers.Dispose();
    }
}
