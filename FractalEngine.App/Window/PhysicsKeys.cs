using FractalEngine.Render.Windowing;

namespace FractalEngine.App.Window;

/// <summary>The keys that let time pass, drop balls and let a player walk.</summary>
internal static class PhysicsKeys
{
    /// <summary>Does what a key asks for.</summary>
    /// <returns>What to say; null for keys that mean nothing here.</returns>
    public static string? Apply(Document document, Key key)
    {
        var physics = document.Physics;
        switch (key)
        {
            case Key.Space when !physics.IsWalking || physics.IsPaused:
                return physics.TogglePause();
            case Key.N:
                return physics.StepOnce();
            case Key.R:
                return physics.Reset();
            case Key.B:
                return physics.DropSphere(document.Camera);
            case Key.C:
                return physics.SwitchCollider();
            case Key.P:
                return document.ToggleWalking();
            case Key.V:
                physics.ShowsClosestPoints = !physics.ShowsClosestPoints;
                return physics.ShowsClosestPoints ? "closest points and normals are shown" : "closest points are hidden";
            default:
                return null;
        }
    }
}
