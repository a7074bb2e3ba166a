using System.Runtime.InteropServices;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Render.Drawables;
using FractalEngine.Render.Gl;
using FractalEngine.Render.Gl.State;
using FractalEngine.Render.Preparation;
using OpenTK.Graphics.OpenGL4;

namespace FractalEngine.Render.Upload;

/// <summary>Draws the spheres beside a scene's objects in one call. Their positions are uploaded anew for each frame.</summary>
internal sealed class SphereBatch : IDisposable
{
    private const int FaceCount = 1280;

    private readonly ModelBuffers _modelBuffers;
    private readonly GlBuffer _instances;
    private readonly VertexArray _vertexArray;
    private readonly ObjectBlock _objectBlock;
    private readonly List<float> _rows = [];

    /// <summary>Uploads the mesh of a unit sphere.</summary>
    /// <exception cref="GlException">The GPU's memory does not suffice.</exception>
    public SphereBatch(GlResources resources)
    {
        var model = new MeshModel(MeshGenerators.Create("icosphere", 0, FaceCount)) { SourcePath = "sphere" };
        var scene = new LoadedScene(new Scene(), [new(new SceneObject("sphere", Transformation.Identity), model)]);
        _modelBuffers = new(resources, DrawableScene.Prepare(scene, new() { Culling = null }).Models[0]);
        _instances = new(resources, "spheres", BufferTarget.ArrayBuffer);
        _vertexArray = new(resources, "spheres");
        _modelBuffers.Attach(_vertexArray, _instances);
        _objectBlock = new(resources, "spheres");
    }

    /// <summary>Draws spheres with the program in use, whose instances must be relative to the camera.</summary>
    /// <param name="spheres">Spheres to draw.</param>
    /// <param name="cameraPosition">Position of the camera in world space.</param>
    /// <param name="colour">Colour of all spheres, sRGB.</param>
    public void Draw(IReadOnlyList<SphereInstance> spheres, Vector cameraPosition, Colour colour)
    {
        CollectionsMarshal.SetCount(_rows, spheres.Count * DrawableModel.FloatsPerInstance);
        var rows = CollectionsMarshal.AsSpan(_rows);
        for (var i = 0; i < spheres.Count; i++)
        {
            var (centre, radius) = spheres[i];
            var linear = Matrix.Diagonal(radius * Vector.One);
            InstanceRow.Write(linear, centre - cameraPosition, rows[(i * DrawableModel.FloatsPerInstance)..]);
        }

        _instances.Discard(rows.Length * sizeof(float));
        _instances.Write(rows, 0);
        _objectBlock.Bind(GlState.ObjectBinding, AffineMap.Translate(cameraPosition), colour, colour, cameraPosition);
        _vertexArray.DrawTriangles(0, _modelBuffers.WholeMesh.IndexCount, spheres.Count);
    }

    /// <inheritdoc/>
    public void Dispose() => GlObject.DisposeAll(_vertexArray, _instances, _objectBlock, _modelBuffers);
}
