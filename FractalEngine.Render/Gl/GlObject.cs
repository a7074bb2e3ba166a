using FractalEngine.Render.Gl.State;
using OpenTK.Graphics.OpenGL4;

namespace FractalEngine.Render.Gl;

/// <summary>
/// Base class of GL objects. Exactly one owner disposes each of them. There is no finalizer, since it would run on a thread without a
/// context; an object that was not disposed is reported by name when the context ends.
/// </summary>
internal abstract class GlObject : IDisposable
{
    private bool _isDisposed;

    /// <summary>Registers the object with its context.</summary>
    /// <param name="resources">Resources of the current context.</param>
    /// <param name="label">Purpose of the object, for messages.</param>
    /// <exception cref="InvalidOperationException">This is not the context's thread.</exception>
    protected GlObject(GlResources resources, string label)
    {
        Resources = resources;
        Label = label;
        resources.Add(this);
    }

    /// <summary>Purpose of the object, for messages.</summary>
    public string Label { get; }

    /// <summary>Resources of the context that the object belongs to.</summary>
    protected GlResources Resources { get; }

    /// <summary>
    /// Deletes the object at once where its context is current, otherwise when that is next drawn in. Harmless when repeated.
    /// </summary>
    public void Dispose()
    {
        if (!_isDisposed)
        {
            _isDisposed = true;
            Resources.Remove(this);
        }
    }

    /// <summary>Returns the kind and the label of the object.</summary>
    public sealed override string ToString() => $"{GetType().Name} '{Label}'";

    /// <summary>Disposes GL objects and their owners in the given order; those that were never made are null.</summary>
    public static void DisposeAll(params ReadOnlySpan<IDisposable?> items)
    {
        foreach (var item in items)
        {
            item?.Dispose();
        }
    }

    /// <summary>Runs the second part of a constructor, and disposes what the first part has made where the second fails.</summary>
    /// <param name="owner">The object under construction.</param>
    /// <param name="initialise">Allocates or builds what may not fit or be refused.</param>
    public static void DisposeOnFailure(IDisposable owner, Action initialise)
    {
        try
        {
            initialise();
        }
        catch
        {
            owner.Dispose();
            throw;
        }
    }

    /// <summary>Disposes the object, and throws, unless the framebuffer that is bound can be drawn into.</summary>
    /// <param name="size">The size of the object, for the message.</param>
    /// <exception cref="GlException">Size or memory exceed the driver's limits.</exception>
    protected void ThrowUnlessComplete(string size)
    {
        var status = GL.CheckFramebufferStatus(FramebufferTarget.Framebuffer);
        if (status != FramebufferErrorCode.FramebufferComplete || GL.GetError() != ErrorCode.NoError)
        {
            Dispose();
            throw new GlException($"{this} of {size} is beyond the driver ({status})");
        }
    }

    /// <summary>Calls the matching glDelete function. Runs once, on the context's thread.</summary>
    protected internal abstract void Delete();
}
